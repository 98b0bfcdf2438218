; Rules 3 and 4: nothing overflows in the guard band. Theory: nonlinear real arithmetic.
;
; Variables: vertices p, q and r, and a sample s, anywhere in the guard band.

(declare-const px Real) (declare-const py Real)
(declare-const qx Real) (declare-const qy Real)
(declare-const rx Real) (declare-const ry Real)
(declare-const sx Real) (declare-const sy Real)
(assert (and (in_guard px) (in_guard py) (in_guard qx) (in_guard qy)))
(assert (and (in_guard rx) (in_guard ry) (in_guard sx) (in_guard sy)))
(define-fun a () Real (edge_a py qy))
(define-fun b () Real (edge_b px qx))

;; claim samples_in_guard: Every sample of the largest image lies in the guard band.
(declare-const p Int)
(assert (pixel_in_image p))
(assert (not (in_guard (to_real (sample_q15 p)))))

;; weakened samples_in_guard: So does the sample after the last.
(declare-const p Int)
(assert (and (<= 0 p) (<= p kMaxImageSide)))
(assert (not (in_guard (to_real (sample_q15 p)))))

;; claim differences: A difference of coordinates is at most 2^23 in size.
(assert (not (between (- 8388608.0) (- sx px) 8388608.0)))

;; weakened differences: It fits 24 signed bits.
(assert (not (between (- 8388608.0) (- sx px) 8388607.0)))

;; claim edge_terms: a s.x, b s.y and the constant c of Edge, and every partial sum of them, fit 64 bits with 15 to
;;   spare: they stay below 2^48.
(define-fun c () Real (+ (- 1.0) (- (* a px)) (- (* b py))))
(define-fun fits ((v Real)) Bool (between (- 281474976710656.0) v 281474976710656.0))
(assert (not (and (fits (* a px)) (fits (* b py)) (fits (* a sx)) (fits (* b sy)) (fits c)
                  (fits (+ (* a sx) (* b sy))))))

;; weakened edge_terms: They fit with 18 bits to spare.
(define-fun fits ((v Real)) Bool (between (- 35184372088832.0) v 35184372088832.0))
(assert (not (fits (+ (* a sx) (* b sy)))))

;; claim edge_width: |E| <= 2^47 = kMaxEdge_q30, from the sizes of its two products.
(assert (not (between (- (to_real kMaxEdge_q30)) (edge_at px py qx qy sx sy) (to_real kMaxEdge_q30))))

;; weakened edge_width: |E| < 2^46.
(assert (not (< (edge_at px py qx qy sx sy) 70368744177664.0)))
(assert (= sx 4194304.0))

;; claim twice_area: Twice the area of a triangle is at most the area of its bounding box: 2^46 in the guard band. An
;;   edge value is twice the signed area of p, q and s, so |E| <= 2^46, too.
(assert (not (between (- (to_real two46)) (signed_area px py qx qy rx ry) (to_real two46))))

;; weakened twice_area: It is less than that.
(assert (not (< (signed_area px py qx qy rx ry) (to_real two46))))
(assert (and (= px (- 4194304.0)) (= py (- 4194304.0))))

;; claim code_form: Edge::at() computes E: a s.x + b s.y - a p.x - b p.y is a (s.x - p.x) + b (s.y - p.y).
(assert (not (= (+ (* a sx) (* b sy) (- (* a px)) (- (* b py))) (edge_at px py qx qy sx sy))))

;; weakened code_form: The same with the constant a q.x - b q.y.
(assert (not (= (+ (* a sx) (* b sy) (* a qx) (- (* b qy))) (edge_at px py qx qy sx sy))))
