; Acceptance and rejection of cells, tiles and blocks (bins.cpp, tile_setup-inl.h, tile_candidates-inl.h, hiz-inl.h): none
; with a covered pixel is rejected, none with a pixel outside is accepted. Theories: nonlinear real arithmetic; linear
; integer arithmetic for shifted values.
;
; f + x a + y b is an edge value or a depth at pixel (x, y) of a box, counted from its first pixel; (last_x, last_y)
; is the last.

(define-const kBlockSide Real 4.0)     ; = kBlockSide of src/raster/tile_store-inl.h
(define-const kSteep Int 16777216)     ; = kSteep of src/raster/simd/depth_lanes-inl.h

(declare-const f Real) (declare-const a Real) (declare-const b Real)
(declare-const x Real) (declare-const y Real) (declare-const last_x Real) (declare-const last_y Real)
(assert (and (between 0.0 x last_x) (between 0.0 y last_y)))
(define-fun at ((u Real) (v Real)) Real (+ f (* u a) (* v b)))

;; claim corner_is_largest: If the edge value is negative at the corner that the signs of the steps select, the whole
;;   box is outside.
(assert (< (at (ite (> a 0.0) last_x 0.0) (ite (> b 0.0) last_y 0.0)) 0.0))
(assert (not (< (at x y) 0.0)))

;; weakened corner_is_largest: The same for the opposite corner.
(assert (< (at (ite (> a 0.0) 0.0 last_x) (ite (> b 0.0) 0.0 last_y)) 0.0))
(assert (not (< (at x y) 0.0)))

;; claim trivial_reject: If the sum of the first value and the largest rises is negative, the whole box is outside.
(assert (< (+ f (maxr (* a last_x) 0.0) (maxr (* b last_y) 0.0)) 0.0))
(assert (not (< (at x y) 0.0)))

;; weakened trivial_reject: The same with the rise along one axis only.
(assert (< (+ f (maxr (* a last_x) 0.0)) 0.0))
(assert (not (< (at x y) 0.0)))

;; claim trivial_accept: If the sum of the first value and the largest falls is not negative, the whole box is inside.
;;   Applied to a depth plane less a depth, it shows that no pixel of a box is nearer than that depth.
(assert (>= (+ f (minr (* a last_x) 0.0) (minr (* b last_y) 0.0)) 0.0))
(assert (not (>= (at x y) 0.0)))

;; weakened trivial_accept: The same with the fall along one axis only.
(assert (>= (+ f (minr (* a last_x) 0.0)) 0.0))
(assert (not (>= (at x y) 0.0)))

;; claim rise_and_span: In a block, f + rise is the largest value and f + rise - span the least. Both occur at a
;;   corner, so these bounds are exact.
(assert (and (= last_x (- kBlockSide 1.0)) (= last_y last_x)))
(define-fun rise () Real (* (- kBlockSide 1.0) (+ (maxr a 0.0) (maxr b 0.0))))
(define-fun span () Real (* (- kBlockSide 1.0) (+ (absr a) (absr b))))
(define-fun corner ((v Real)) Bool
  (or (= v (at 0.0 0.0)) (= v (at last_x 0.0)) (= v (at 0.0 last_y)) (= v (at last_x last_y))))
(assert (not (and (between (- (+ f rise) span) (at x y) (+ f rise)) (corner (+ f rise)) (corner (- (+ f rise) span)))))

;; weakened rise_and_span: The same with one step less.
(assert (and (= last_x (- kBlockSide 1.0)) (= last_y last_x)))
(define-fun rise () Real (* (- kBlockSide 2.0) (+ (maxr a 0.0) (maxr b 0.0))))
(define-fun span () Real (* (- kBlockSide 2.0) (+ (absr a) (absr b))))
(assert (not (between (- (+ f rise) span) (at x y) (+ f rise))))

;; claim may_fill_blocks: Inside a triangle an edge value lies between 0 and twice the area, and over a block inside
;;   the triangle it falls by its span. So an edge whose span, in square pixels, exceeds twice the area fills no
;;   block. least is the edge value where it is least; others is the sum of the other two edge values where this one
;;   is largest.
(declare-const span Int) (declare-const area Int) (declare-const least Int) (declare-const others Int)
(assert (and (>= least 0) (>= others 0) (= area (+ least (* kPixel_q15 span) others))))
(assert (not (<= (div span kPixel_q15) (div area two16))))

;; weakened may_fill_blocks: Nor does an edge whose span equals twice the area.
(declare-const span Int) (declare-const area Int) (declare-const least Int) (declare-const others Int)
(assert (and (>= least 0) (>= others 0) (= area (+ least (* kPixel_q15 span) others))))
(assert (not (< (div span kPixel_q15) (div area two16))))

;; claim gentle_bound: Let a plane have steps below kSteep, and be within the depth range at a pixel. At a pixel up to
;;   63 px away on both axes, its value wrapped to 32 bits is at most the exact value, so a wrapped value counts as
;;   near. z is the plane at the first pixel, (u, v) the offset.
(declare-const z Int) (declare-const way Real) (declare-const far Int) (declare-const u Real) (declare-const v Real)
(assert (and (<= 0 z) (<= z kDepthClear) (< (absr a) (to_real kSteep)) (< (absr b) (to_real kSteep))))
(assert (and (between (- 63.0) u 63.0) (between (- 63.0) v 63.0)))
(assert (= way (+ (* u a) (* v b))))
(assert (= (to_real far) (+ (to_real z) way)))
(assert (not (<= (signed32 far) far)))

;; weakened gentle_bound: The same with steps below twice kSteep.
(declare-const z Int) (declare-const way Real) (declare-const far Int) (declare-const u Real) (declare-const v Real)
(assert (and (<= 0 z) (<= z kDepthClear) (< (absr a) (* 2.0 (to_real kSteep))) (< (absr b) (* 2.0 (to_real kSteep)))))
(assert (and (between (- 63.0) u 63.0) (between (- 63.0) v 63.0)))
(assert (= way (+ (* u a) (* v b))))
(assert (= (to_real far) (+ (to_real z) way)))
(assert (= u v 63.0))
(assert (not (<= (signed32 far) far)))
