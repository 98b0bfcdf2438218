; How cells, tiles and blocks are accepted and rejected (bins.cpp, tile_setup-inl.h, tile_rows-inl.h, hiz-inl.h):
; never one that holds a pixel is rejected, never one with a pixel outside is accepted. Theories: nonlinear real
; arithmetic; linear integer arithmetic for what is shifted.
;
; f + x a + y b is an edge value or a depth, by pixels from a box's first one, of which (last_x, last_y) is the last,
; (x, y) any.

(define-const kBlockSide Real 4.0)     ; = kBlockSide of src/raster/tiled/tile_setup-inl.h
(define-const kSteep Int 16777216)     ; = kSteep of src/raster/simd/depth_lanes-inl.h

(declare-const f Real) (declare-const a Real) (declare-const b Real)
(declare-const x Real) (declare-const y Real) (declare-const last_x Real) (declare-const last_y Real)
(assert (and (between 0.0 x last_x) (between 0.0 y last_y)))
(define-fun at ((u Real) (v Real)) Real (+ f (* u a) (* v b)))

;; claim corner_is_largest: A box whose value is negative at the corner that the signs of the steps choose is outside.
(assert (< (at (ite (> a 0.0) last_x 0.0) (ite (> b 0.0) last_y 0.0)) 0.0))
(assert (not (< (at x y) 0.0)))

;; weakened corner_is_largest: Or at the opposite corner.
(assert (< (at (ite (> a 0.0) 0.0 last_x) (ite (> b 0.0) 0.0 last_y)) 0.0))
(assert (not (< (at x y) 0.0)))

;; claim trivial_reject: A box whose first value and largest rises sum up to less than zero is outside.
(assert (< (+ f (maxr (* a last_x) 0.0) (maxr (* b last_y) 0.0)) 0.0))
(assert (not (< (at x y) 0.0)))

;; weakened trivial_reject: With the rise of one axis only.
(assert (< (+ f (maxr (* a last_x) 0.0)) 0.0))
(assert (not (< (at x y) 0.0)))

;; claim trivial_accept: One whose first value and largest falls do not is inside. By the same sum, of a depth plane
;;   less a depth, nothing in a box is nearer than that depth.
(assert (>= (+ f (minr (* a last_x) 0.0) (minr (* b last_y) 0.0)) 0.0))
(assert (not (>= (at x y) 0.0)))

;; weakened trivial_accept: With the fall of one axis only.
(assert (>= (+ f (minr (* a last_x) 0.0)) 0.0))
(assert (not (>= (at x y) 0.0)))

;; claim rise_and_span: In a block, f + rise is the largest value and f + rise - span the least, and both are met: the
;;   block may be judged by them.
(assert (and (= last_x (- kBlockSide 1.0)) (= last_y last_x)))
(define-fun rise () Real (* (- kBlockSide 1.0) (+ (maxr a 0.0) (maxr b 0.0))))
(define-fun span () Real (* (- kBlockSide 1.0) (+ (absr a) (absr b))))
(define-fun corner ((v Real)) Bool
  (or (= v (at 0.0 0.0)) (= v (at last_x 0.0)) (= v (at 0.0 last_y)) (= v (at last_x last_y))))
(assert (not (and (between (- (+ f rise) span) (at x y) (+ f rise)) (corner (+ f rise)) (corner (- (+ f rise) span)))))

;; weakened rise_and_span: With steps for a pixel less.
(assert (and (= last_x (- kBlockSide 1.0)) (= last_y last_x)))
(define-fun rise () Real (* (- kBlockSide 2.0) (+ (maxr a 0.0) (maxr b 0.0))))
(define-fun span () Real (* (- kBlockSide 2.0) (+ (absr a) (absr b))))
(assert (not (between (- (+ f rise) span) (at x y) (+ f rise))))

;; claim may_fill_blocks: An edge value falls by its span over a block that lies inside, and never rises above twice
;;   the area, so an edge with a larger span, in pixels squared, fills no block. least is the value where it is least,
;;   the others' sum is what is left of twice the area where it is largest.
(declare-const span Int) (declare-const area Int) (declare-const least Int) (declare-const others Int)
(assert (and (>= least 0) (>= others 0) (= area (+ least (* kSub span) others))))
(assert (not (<= (div span kSub) (div area two16))))

;; weakened may_fill_blocks: Nor does one with as large a span.
(declare-const span Int) (declare-const area Int) (declare-const least Int) (declare-const others Int)
(assert (and (>= least 0) (>= others 0) (= area (+ least (* kSub span) others))))
(assert (not (< (div span kSub) (div area two16))))

;; claim gentle_bound: A plane with steps below kSteep, taken at a pixel of a tile up to 63 pixels away on both axes
;;   from one where it is within the depths, is in 32 bits at most what it is: wrapping, it passes as near. z is the
;;   plane at a pixel of the triangle, (u, v) the way from there.
(declare-const z Int) (declare-const way Real) (declare-const far Int) (declare-const u Real) (declare-const v Real)
(assert (and (<= 0 z) (<= z kDepthClear) (< (absr a) (to_real kSteep)) (< (absr b) (to_real kSteep))))
(assert (and (between (- 63.0) u 63.0) (between (- 63.0) v 63.0)))
(assert (= way (+ (* u a) (* v b))))
(assert (= (to_real far) (+ (to_real z) way)))
(assert (not (<= (signed32 far) far)))

;; weakened gentle_bound: With steps below twice kSteep.
(declare-const z Int) (declare-const way Real) (declare-const far Int) (declare-const u Real) (declare-const v Real)
(assert (and (<= 0 z) (<= z kDepthClear) (< (absr a) (* 2.0 (to_real kSteep))) (< (absr b) (* 2.0 (to_real kSteep)))))
(assert (and (between (- 63.0) u 63.0) (between (- 63.0) v 63.0)))
(assert (= way (+ (* u a) (* v b))))
(assert (= (to_real far) (+ (to_real z) way)))
(assert (= u v 63.0))
(assert (not (<= (signed32 far) far)))
