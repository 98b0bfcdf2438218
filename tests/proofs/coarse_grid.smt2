; The coarse grid (core/grid.h): where the 7 spare bits of all positions are 0, kernels drop them and find the same
; pixels and depths. Theories: linear integer arithmetic for roundings; nonlinear real arithmetic for polynomials.
;
; A number on the coarse grid is one in sub-units of 1/256 px. Its value in 2^-15 px is 2^7 times as large.

(define-const spare Int 128)    ; 2^7
(define-const two24 Int 16777216)
(define-fun coarse_sample ((pixel Int)) Int (+ (* 256 pixel) 128))

;; claim coarse_samples: Samples lie on the coarse grid.
(declare-const pixel Int)
(assert (not (= (sample_q15 pixel) (* spare (coarse_sample pixel)))))

;; weakened coarse_samples: Samples lie on a grid of whole pixels.
(declare-const pixel Int)
(assert (not (= (mod (sample_q15 pixel) kPixel_q15) 0)))

;; claim coarse_boxes: The first sample at or after a coordinate is the same.
(declare-const c Int)
(assert (not (= (first_sample (* spare c)) (div (+ c 127) 256))))

;; weakened coarse_boxes: It is the same if spare bits are dropped that are not 0.
(declare-const c Int)
(assert (not (= (first_sample c) (div (+ (div c spare) 127) 256))))

;; claim coarse_edges: An edge value is 2^14 times as large.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const sx Real) (declare-const sy Real)
(define-fun fine ((v Real)) Real (* 128.0 v))
(assert (not (= (edge_at (fine px) (fine py) (fine qx) (fine qy) (fine sx) (fine sy))
                (* 16384.0 (edge_at px py qx qy sx sy)))))

;; weakened coarse_edges: It is 2^7 times as large.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const sx Real) (declare-const sy Real)
(define-fun fine ((v Real)) Real (* 128.0 v))
(assert (not (= (edge_at (fine px) (fine py) (fine qx) (fine qy) (fine sx) (fine sy))
                (* 128.0 (edge_at px py qx qy sx sy)))))

;; claim coarse_bias: So the biased value has the same sign.
(declare-const e Int) (declare-const bias_of_edge Int)
(assert (or (= bias_of_edge 0) (= bias_of_edge (- 1))))
(assert (not (= (< (+ (* two14 e) bias_of_edge) 0) (< (+ e bias_of_edge) 0))))

;; weakened coarse_bias: It has the same sign for any bias that is not positive.
(declare-const e Int) (declare-const bias_of_edge Int)
(assert (<= bias_of_edge 0))
(assert (not (= (< (+ (* two14 e) bias_of_edge) 0) (< (+ e bias_of_edge) 0))))

;; claim coarse_gradients: The numerator n of a gradient is 2^7 times as large, the area 2^14 times: floor(2^31 2^7 n /
;;   (2^14 area)) = floor(2^24 n / area) = g.
(declare-const n Real) (declare-const area Real) (declare-const g Real)
(define-fun rest () Real (- (* 16777216.0 n) (* g area)))
(define-fun fine_rest () Real (- (* 2147483648.0 128.0 n) (* g 16384.0 area)))
(assert (and (> area 0.0) (<= 0.0 rest) (< rest area)))
(assert (not (and (<= 0.0 fine_rest) (< fine_rest (* 16384.0 area)))))

;; weakened coarse_gradients: The same with 2^32 2^7 n.
(declare-const n Real) (declare-const area Real) (declare-const g Real)
(define-fun rest () Real (- (* 16777216.0 n) (* g area)))
(define-fun fine_rest () Real (- (* 4294967296.0 128.0 n) (* g 16384.0 area)))
(assert (and (> area 0.0) (<= 0.0 rest) (< rest area)))
(assert (not (and (<= 0.0 fine_rest) (< fine_rest (* 16384.0 area)))))

;; claim coarse_planes: A plane's value with 24 fraction bits is the value with 31 less the 7 lowest, which are 0.
(declare-const z Int)
(declare-const x_product Int) (declare-const y_product Int)  ; gx dx, gy dy
(define-fun coarse () Int (+ (* two24 z) 8388608 x_product y_product))
(define-fun fine () Int (+ (* two31 z) two30 (* spare x_product) (* spare y_product)))
(assert (not (and (= fine (* spare coarse)) (= (div fine two31) (div coarse two24)))))

;; weakened coarse_planes: The same without adding 1/2 on the fine grid.
(declare-const z Int)
(declare-const x_product Int) (declare-const y_product Int)
(define-fun coarse () Int (+ (* two24 z) 8388608 x_product y_product))
(define-fun fine () Int (+ (* two31 z) (* spare x_product) (* spare y_product)))
(assert (not (= (div fine two31) (div coarse two24))))
