; pixel_box(): a sample outside the box, or on its right or lower side, belongs to no triangle. Theories: nonlinear
; real arithmetic for the sides, linear integer arithmetic for first_sample().
;
; A triangle p q r of positive area, and a sample s that it owns.

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

;; weakened left: Nor straight below the leftmost.
(assert a_triangle_owns_s)
(assert (and (<= sx px) (<= sx qx) (<= sx rx)))

;; claim top: s is not above all vertices.
(assert a_triangle_owns_s)
(assert (and (< sy py) (< sy qy) (< sy ry)))

;; weakened top: Nor on the box's upper side.
(assert a_triangle_owns_s)
(assert (and (<= sy py) (<= sy qy) (<= sy ry)))

;; claim right: s is not on the box's right side, nor beyond.
(assert a_triangle_owns_s)
(assert (and (>= sx px) (>= sx qx) (>= sx rx)))

;; weakened right: Nor within half a pixel of it.
(assert a_triangle_owns_s)
(assert (and (>= (+ sx 128.0) px) (>= (+ sx 128.0) qx) (>= (+ sx 128.0) rx)))

;; claim bottom: s is not on the box's lower side, nor beyond.
(assert a_triangle_owns_s)
(assert (and (>= sy py) (>= sy qy) (>= sy ry)))

;; weakened bottom: Nor within half a pixel of it.
(assert a_triangle_owns_s)
(assert (and (>= (+ sy 128.0) py) (>= (+ sy 128.0) qy) (>= (+ sy 128.0) ry)))

;; claim first_sample: A pixel's sample is at or after a coordinate exactly from first_sample() of it on, so the
;;   pixels from first_sample(min) to before first_sample(max) are those with min <= sample < max.
(declare-const c Int) (declare-const pixel Int)
(assert (not (= (<= c (sample_sub pixel)) (<= (first_sample c) pixel))))

;; weakened first_sample: Exactly after it.
(declare-const c Int) (declare-const pixel Int)
(assert (not (= (< c (sample_sub pixel)) (<= (first_sample c) pixel))))

;; claim empty_box: If a triangle owns a sample, its box is not empty, for min <= sample < max.
(declare-const least Int) (declare-const most Int) (declare-const pixel Int)
(assert (and (<= least (sample_sub pixel)) (< (sample_sub pixel) most)))
(assert (not (< (first_sample least) (first_sample most))))

;; weakened empty_box: If a vertex is left of another.
(declare-const least Int) (declare-const most Int)
(assert (< least most))
(assert (not (< (first_sample least) (first_sample most))))
