; pixel_box(): a triangle covers no sample outside its box, or on the box's right or lower side. Theories: nonlinear
; real arithmetic for the sides, linear integer arithmetic for first_sample().
;
; Variables: a triangle p q r of positive area, and a sample s that it covers.

(declare-const px Real) (declare-const py Real)
(declare-const qx Real) (declare-const qy Real)
(declare-const rx Real) (declare-const ry Real)
(declare-const sx Real) (declare-const sy Real)
(define-fun a_triangle_owns_s () Bool
  (and (> (signed_area px py qx qy rx ry) 0.0)
       (owns px py qx qy sx sy) (owns qx qy rx ry sx sy) (owns rx ry px py sx sy)))

;; claim left: s is not left of all vertices.
(assert a_triangle_owns_s)
(assert (and (< sx px) (< sx qx) (< sx rx)))

;; weakened left: Nor does s have the x of the leftmost vertex.
(assert a_triangle_owns_s)
(assert (and (<= sx px) (<= sx qx) (<= sx rx)))

;; claim top: s is not above all vertices.
(assert a_triangle_owns_s)
(assert (and (< sy py) (< sy qy) (< sy ry)))

;; weakened top: Nor is it on the box's upper side.
(assert a_triangle_owns_s)
(assert (and (<= sy py) (<= sy qy) (<= sy ry)))

;; claim right: s is not on the box's right side, nor right of it.
(assert a_triangle_owns_s)
(assert (and (>= sx px) (>= sx qx) (>= sx rx)))

;; weakened right: Nor is it within half a pixel of that side.
(assert a_triangle_owns_s)
(assert (and (>= (+ sx 128.0) px) (>= (+ sx 128.0) qx) (>= (+ sx 128.0) rx)))

;; claim bottom: s is not on the box's lower side, nor below it.
(assert a_triangle_owns_s)
(assert (and (>= sy py) (>= sy qy) (>= sy ry)))

;; weakened bottom: Nor is it within half a pixel of that side.
(assert a_triangle_owns_s)
(assert (and (>= (+ sy 128.0) py) (>= (+ sy 128.0) qy) (>= (+ sy 128.0) ry)))

;; claim first_sample: The sample of a pixel is at or after a coordinate exactly if the pixel is at or after
;;   first_sample() of it. So the pixels from first_sample(min) to before first_sample(max) are those with min <=
;;   sample < max.
(declare-const c Int) (declare-const pixel Int)
(assert (not (= (<= c (sample_q15 pixel)) (<= (first_sample c) pixel))))

;; weakened first_sample: The same for a sample strictly after the coordinate.
(declare-const c Int) (declare-const pixel Int)
(assert (not (= (< c (sample_q15 pixel)) (<= (first_sample c) pixel))))

;; claim empty_box: If a triangle covers a sample, its box is not empty, because min <= sample < max.
(declare-const least Int) (declare-const most Int) (declare-const pixel Int)
(assert (and (<= least (sample_q15 pixel)) (< (sample_q15 pixel) most)))
(assert (not (< (first_sample least) (first_sample most))))

;; weakened empty_box: If a vertex is left of another, its box is not empty.
(declare-const least Int) (declare-const most Int)
(assert (< least most))
(assert (not (< (first_sample least) (first_sample most))))
