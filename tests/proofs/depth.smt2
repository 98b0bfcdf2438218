; Rule 6: depth stays within 34 units of the exact plane at every sample that the triangle covers, so the head-room
; keeps it from wrapping. The chain of claims:
;
;   numerator_width      |n| <= 2^61, and n is exact in 64 bits                    (nonlinear reals)
;   plane_is_weighted,   at a covered sample the exact plane lies between the
;   plane_between        least and the greatest z of the vertices                   (nonlinear reals)
;   step_error           zx, zy are off by at most 1/2 unit per pixel                 (integers and reals)
;   gradient_gap         gx, gy, rounded down, shift the plane at the middle sample
;                        of a cell by less than 1/2 unit each                       (nonlinear reals)
;   middle_error         so the depth there is off by less than 3/2                 (integers and reals)
;   sample_error         so z(x, y) is off by less than 34                          (nonlinear reals)
;   base_of_middle       the base that the code computes is that depth less 32 steps on
;                        each axis                                                  (integers)
;   head_room            so z(x, y) lies in (0, kDepthClear), wrapped or not        (linear reals)
;   wrapped_base, wrapped_step, wrapped_sum: computed modulo 2^64 and 2^32, the
;                        result is the same number                                      (linear integers)
;
; The premises of each claim are the claims above it.

;; claim numerator_width: |n| <= 2^61 for both gradients, since n is twice the area of a triangle in a box of depths
;;   and coordinates. Each of its two products, and their difference, fits 64 bits.
(declare-const z0 Real) (declare-const z1 Real) (declare-const z2 Real)
(declare-const y0 Real) (declare-const y1 Real) (declare-const y2 Real)
(define-fun depth ((z Real)) Bool
  (between (to_real kDepthHead) z (+ (to_real kDepthHead) (to_real kDepthRange))))
(assert (and (depth z0) (depth z1) (depth z2) (in_guard y0) (in_guard y1) (in_guard y2)))
(define-fun n () Real (- (* (- z1 z0) (- y2 y0)) (* (- z2 z0) (- y1 y0))))
(assert (not (and (between (- (to_real two61)) n (to_real two61))
                  (int32r (- z1 z0)) (int64r (* (- z1 z0) (- y2 y0))) (int64r (* (- z2 z0) (- y1 y0))))))

;; weakened numerator_width: |n| <= 2^53, so that a double holds it exactly.
(declare-const z0 Real) (declare-const z1 Real) (declare-const z2 Real)
(declare-const y0 Real) (declare-const y1 Real) (declare-const y2 Real)
(define-fun depth ((z Real)) Bool
  (between (to_real kDepthHead) z (+ (to_real kDepthHead) (to_real kDepthRange))))
(assert (and (depth z0) (depth z1) (depth z2) (in_guard y0) (in_guard y1) (in_guard y2)))
(define-fun n () Real (- (* (- z1 z0) (- y2 y0)) (* (- z2 z0) (- y1 y0))))
(assert (= y0 (- 536870912.0)))
(assert (= z0 128.0))
(assert (not (between (- (to_real two53)) n (to_real two53))))

;; claim plane_is_weighted: The plane with the gradients n_x / area and n_y / area per sub-unit, anchored at any
;;   vertex, is the mean of the vertices' depths weighted by the edge values opposite them.
(declare-const x0 Real) (declare-const x1 Real) (declare-const x2 Real)
(declare-const y0 Real) (declare-const y1 Real) (declare-const y2 Real)
(declare-const z0 Real) (declare-const z1 Real) (declare-const z2 Real)
(declare-const sx Real) (declare-const sy Real)
(define-fun nx () Real (- (* (- z1 z0) (- y2 y0)) (* (- z2 z0) (- y1 y0))))
(define-fun ny () Real (- (* (- z2 z0) (- x1 x0)) (* (- z1 z0) (- x2 x0))))
(define-fun area () Real (signed_area x0 y0 x1 y1 x2 y2))
(define-fun weighted () Real (+ (* (edge_at x1 y1 x2 y2 sx sy) z0) (* (edge_at x2 y2 x0 y0 sx sy) z1)
                                (* (edge_at x0 y0 x1 y1 sx sy) z2)))
(define-fun from_vertex ((x Real) (y Real) (z Real)) Real (+ (* area z) (* nx (- sx x)) (* ny (- sy y))))
(assert (not (and (= (from_vertex x0 y0 z0) weighted) (= (from_vertex x1 y1 z1) weighted)
                  (= (from_vertex x2 y2 z2) weighted)
                  (= area (+ (edge_at x0 y0 x1 y1 sx sy) (edge_at x1 y1 x2 y2 sx sy) (edge_at x2 y2 x0 y0 sx sy))))))

;; weakened plane_is_weighted: The same with the edge values of the edges that begin at the vertices.
(declare-const x0 Real) (declare-const x1 Real) (declare-const x2 Real)
(declare-const y0 Real) (declare-const y1 Real) (declare-const y2 Real)
(declare-const z0 Real) (declare-const z1 Real) (declare-const z2 Real)
(declare-const sx Real) (declare-const sy Real)
(define-fun nx () Real (- (* (- z1 z0) (- y2 y0)) (* (- z2 z0) (- y1 y0))))
(define-fun ny () Real (- (* (- z2 z0) (- x1 x0)) (* (- z1 z0) (- x2 x0))))
(define-fun weighted () Real (+ (* (edge_at x0 y0 x1 y1 sx sy) z0) (* (edge_at x1 y1 x2 y2 sx sy) z1)
                                (* (edge_at x2 y2 x0 y0 sx sy) z2)))
(assert (not (= (+ (* (signed_area x0 y0 x1 y1 x2 y2) z0) (* nx (- sx x0)) (* ny (- sy y0))) weighted)))

;; claim plane_between: A mean with non-negative weights, such as the edge values of a covered sample, lies between
;;   the least and the greatest of its numbers.
(declare-const w0 Real) (declare-const w1 Real) (declare-const w2 Real)
(declare-const z0 Real) (declare-const z1 Real) (declare-const z2 Real)
(declare-const plane Real)
(assert (and (>= w0 0.0) (>= w1 0.0) (>= w2 0.0) (> (+ w0 w1 w2) 0.0)))
(assert (= (* (+ w0 w1 w2) plane) (+ (* w0 z0) (* w1 z1) (* w2 z2))))
(assert (not (between (minr z0 (minr z1 z2)) plane (maxr z0 (maxr z1 z2)))))

;; weakened plane_between: The same for a sample just outside an edge.
(declare-const w0 Real) (declare-const w1 Real) (declare-const w2 Real)
(declare-const z0 Real) (declare-const z1 Real) (declare-const z2 Real)
(declare-const plane Real)
(assert (and (>= w0 (- 1.0)) (>= w1 0.0) (>= w2 0.0) (> (+ w0 w1 w2) 0.0)))
(assert (= (* (+ w0 w1 w2) plane) (+ (* w0 z0) (* w1 z1) (* w2 z2))))
(assert (not (between (minr z0 (minr z1 z2)) plane (maxr z0 (maxr z1 z2)))))

;; claim step_error: |zx - G / 2^16| <= 1/2, for the true gradient G and gx = floor(G): rounding floor(G) half up
;;   gives the same as rounding G half up.
(declare-const g Int) (declare-const true_g Real)
(assert (and (<= (to_real g) true_g) (< true_g (to_real (+ g 1)))))
(assert (not (<= (absr (- (* 65536.0 (to_real (depth_step g))) true_g)) 32768.0)))

;; weakened step_error: |zx - G / 2^16| < 1/2.
(declare-const g Int) (declare-const true_g Real)
(assert (and (<= (to_real g) true_g) (< true_g (to_real (+ g 1)))))
(assert (not (< (absr (- (* 65536.0 (to_real (depth_step g))) true_g)) 32768.0)))

;; claim gradient_gap: A gradient that is too small by less than 1 (2^-31 units per 2^-15 px) shifts the plane by less
;;   than 2^30 (1/2 unit) over the at most 2^30 from anchor to sample. An exact gradient does not shift it.
(declare-const gap Real) (declare-const d Real)
(assert (and (<= 0.0 gap) (< gap 1.0) (between (- 1073741824.0) d 1073741824.0)))
(assert (not (< (absr (* gap d)) 1073741824.0)))

;; weakened gradient_gap: The same over 2^30 + 1.
(declare-const gap Real) (declare-const d Real)
(assert (and (<= 0.0 gap) (< gap 1.0) (between (- 1073741825.0) d 1073741825.0)))
(assert (not (< (absr (* gap d)) 1073741824.0)))

;; claim middle_error: The depth at the middle sample is off by less than 3/2. s = gx dx + gy dy is the computed sum;
;;   off_x and off_y are the shifts due to the gradients' rounding; the plane is exact, in units of 2^-31.
(declare-const z Int) (declare-const s Int) (declare-const off_x Real) (declare-const off_y Real)
(assert (and (< (absr off_x) 1073741824.0) (< (absr off_y) 1073741824.0)))
(define-fun middle () Int (div (+ (* two31 z) 1073741824 s) two31))
(define-fun plane () Real (+ (* 2147483648.0 (to_real z)) (to_real s) off_x off_y))
(assert (not (< (absr (- (* 2147483648.0 (to_real middle)) plane)) (* 1.5 2147483648.0))))

;; weakened middle_error: It is off by less than 5/4.
(declare-const z Int) (declare-const s Int) (declare-const off_x Real) (declare-const off_y Real)
(assert (and (< (absr off_x) 1073741824.0) (< (absr off_y) 1073741824.0)))
(define-fun middle () Int (div (+ (* two31 z) 1073741824 s) two31))
(define-fun plane () Real (+ (* 2147483648.0 (to_real z)) (to_real s) off_x off_y))
(assert (not (< (absr (- (* 2147483648.0 (to_real middle)) plane)) (* 1.25 2147483648.0))))

;; claim sample_error: Depth at a pixel of a cell, that is, x and y steps from the middle one, is off by less than
;;   kDepthError.
(declare-const off_middle Real) (declare-const off_zx Real) (declare-const off_zy Real)
(declare-const x Real) (declare-const y Real)
(define-fun in_cell ((p Real)) Bool (between (- (/ (to_real kDepthCell) 2.0)) p (- (/ (to_real kDepthCell) 2.0) 1.0)))
(assert (and (< (absr off_middle) 1.5) (<= (absr off_zx) 0.5) (<= (absr off_zy) 0.5)))
(assert (and (in_cell x) (in_cell y)))
(assert (not (< (absr (+ off_middle (* x off_zx) (* y off_zy))) (to_real kDepthError))))

;; weakened sample_error: It is off by less than 33.
(declare-const off_middle Real) (declare-const off_zx Real) (declare-const off_zy Real)
(declare-const x Real) (declare-const y Real)
(define-fun in_cell ((p Real)) Bool (between (- (/ (to_real kDepthCell) 2.0)) p (- (/ (to_real kDepthCell) 2.0) 1.0)))
(assert (and (< (absr off_middle) 1.5) (<= (absr off_zx) 0.5) (<= (absr off_zy) 0.5)))
(assert (and (in_cell x) (in_cell y)))
(assert (not (< (absr (+ off_middle (* x off_zx) (* y off_zy))) (- (to_real kDepthError) 1.0))))

;; claim base_of_middle: 2^20 (gx - 2^16 zx) more than the sum s at the first sample, rounded down, is the sum at the
;;   middle, s + 2^20 gx, rounded down, less 32 zx. gx - 2^16 zx is the lower 16 bits of gx + 2^15, less 2^15.
(declare-const s Int) (declare-const g Int)
(define-fun shift () Int (* 1048576 (- (mod (+ g 32768) two16) 32768)))
(assert (not (= (div (+ s shift) two31) (- (div (+ s (* 1048576 g)) two31) (* 32 (depth_step g))))))

;; weakened base_of_middle: The same without the 2^15.
(declare-const s Int) (declare-const g Int)
(define-fun shift () Int (* 1048576 (mod (+ g 32768) two16)))
(assert (not (= (div (+ s shift) two31) (- (div (+ s (* 1048576 g)) two31) (* 32 (depth_step g))))))

;; claim head_room: A number within kDepthError of a plane between vertex depths neither wraps nor reaches
;;   kDepthClear.
(declare-const z Int) (declare-const plane Real)
(assert (between (to_real kDepthHead) plane (to_real (+ kDepthHead kDepthRange))))
(assert (< (absr (- (to_real z) plane)) (to_real kDepthError)))
(assert (not (and (< 0 z) (< z kDepthClear) (= (mod z two32) z) (= (signed32 z) z))))

;; weakened head_room: The same with a quarter of the head-room.
(declare-const z Int) (declare-const plane Real)
(assert (between 32.0 plane (- (to_real kDepthClear) 32.0)))
(assert (< (absr (- (to_real z) plane)) (to_real kDepthError)))
(assert (not (and (< 0 z) (< z kDepthClear) (= (mod z two32) z) (= (signed32 z) z))))

;; claim wrapped_base: Taking a sum s modulo 2^64 keeps bits 31 to 62: floor(v / 2^31) = floor(s / 2^31) modulo 2^32,
;;   with v = s mod 2^64.
(declare-const s Int) (declare-const v Int) (declare-const k Int)
(assert (and (= s (+ v (* two64 k))) (<= 0 v) (< v two64)))
(assert (not (= (mod (div v two31) two32) (mod (div s two31) two32))))

;; weakened wrapped_base: They are equal modulo 2^34.
(declare-const s Int) (declare-const v Int) (declare-const k Int)
(assert (and (= s (+ v (* two64 k))) (<= 0 v) (< v two64)))
(assert (not (= (mod (div v two31) 17179869184) (mod (div s two31) 17179869184))))

;; claim wrapped_step: Taking a sum s modulo 2^64 keeps bits 16 to 47: floor(v / 2^16) = floor(s / 2^16) modulo 2^32.
(declare-const s Int) (declare-const v Int) (declare-const k Int)
(assert (and (= s (+ v (* two64 k))) (<= 0 v) (< v two64)))
(assert (not (= (mod (div v two16) two32) (mod (div s two16) two32))))

;; weakened wrapped_step: They are equal modulo 2^49.
(declare-const s Int) (declare-const v Int) (declare-const k Int)
(assert (and (= s (+ v (* two64 k))) (<= 0 v) (< v two64)))
(assert (not (= (mod (div v two16) 562949953421312) (mod (div s two16) 562949953421312))))

;; claim wrapped_sum: A sum or product of numbers taken modulo 2^64 differs from that of the numbers by a multiple of
;;   2^64. g and d are numbers, g - 2^64 i and d - 2^64 j their wrapped forms.
(declare-const g Int) (declare-const d Int) (declare-const i Int) (declare-const j Int)
(assert (not (and (= (- (+ g d) (+ (- g (* two64 i)) (- d (* two64 j)))) (* two64 (+ i j)))
                  (= (- (* g d) (* (- g (* two64 i)) (- d (* two64 j))))
                     (* two64 (- (+ (* i d) (* j g)) (* two64 i j)))))))

;; weakened wrapped_sum: The products differ by 2^64 (i d + j g).
(declare-const g Int) (declare-const d Int) (declare-const i Int) (declare-const j Int)
(assert (not (= (- (* g d) (* (- g (* two64 i)) (- d (* two64 j)))) (* two64 (+ (* i d) (* j g))))))
(assert (and (= i 1) (= j 1)))
