; Rule 4: a sample on a shared edge belongs to exactly one of two neighbours, which the bias decides. Theories:
; nonlinear real arithmetic; the bias itself over integers.
;
; Variables: the edge from p to q, triangles p q r and q p t on its two sides, and a sample s.

(declare-const px Real) (declare-const py Real)
(declare-const qx Real) (declare-const qy Real)
(declare-const rx Real) (declare-const ry Real)
(declare-const tx Real) (declare-const ty Real)
(declare-const sx Real) (declare-const sy Real)
(define-fun a () Real (edge_a py qy))
(define-fun b () Real (edge_b px qx))

;; claim antisymmetry: The two neighbours' values of the shared edge, without bias, are each other's negation at every
;;   sample.
(assert (not (= (edge_at px py qx qy sx sy) (- (edge_at qx qy px py sx sy)))))

;; weakened antisymmetry: So are the constants of the two edges, which include the bias.
(define-fun c ((ux Real) (uy Real) (vx Real) (vy Real)) Real
  (+ (to_real (bias (edge_a uy vy) (edge_b ux vx))) (- (* (edge_a uy vy) ux)) (- (* (edge_b ux vx) uy))))
(assert (and (= px 0.0) (= py 0.0) (not (and (= qx 0.0) (= qy 0.0)))))
(assert (not (= (c px py qx qy) (- (c qx qy px py)))))

;; claim one_side_is_top_left: Of an edge and its reverse, exactly one is a top or left edge.
(assert (not (and (= px qx) (= py qy))))
(assert (not (xor (top_left a b) (top_left (- a) (- b)))))

;; weakened one_side_is_top_left: The same even if p and q are the same point.
(assert (not (xor (top_left a b) (top_left (- a) (- b)))))

;; claim no_cracks: Every sample passes the biased test of exactly one of two edges that are each other's reverse.
(assert (not (and (= px qx) (= py qy))))
(assert (not (xor (owns px py qx qy sx sy) (owns qx qy px py sx sy))))

;; weakened no_cracks: The same with the test E >= 0, without bias.
(assert (not (and (= px qx) (= py qy))))
(assert (not (xor (>= (edge_at px py qx qy sx sy) 0.0) (>= (edge_at qx qy px py sx sy) 0.0))))

;; claim neighbours_run_against: Two triangles on opposite sides of p q, both oriented to positive area, traverse that
;;   edge in opposite directions.
(assert (not (= (signed_area px py qx qy rx ry) 0.0)))
(assert (not (= (signed_area px py qx qy tx ty) 0.0)))
(define-fun area_r () Real (signed_area px py qx qy rx ry))
(define-fun area_t () Real (signed_area px py qx qy tx ty))
; The triangles lie on two sides: r's and t's edge values have opposite signs.
(assert (< (* (edge_at px py qx qy rx ry) (edge_at px py qx qy tx ty)) 0.0))
(assert (not (xor (> area_r 0.0) (> area_t 0.0))))

;; weakened neighbours_run_against: The same for triangles on any sides.
(assert (not (= (signed_area px py qx qy rx ry) 0.0)))
(assert (not (= (signed_area px py qx qy tx ty) 0.0)))
(assert (not (xor (> (signed_area px py qx qy rx ry) 0.0) (> (signed_area px py qx qy tx ty) 0.0))))

;; claim inner_side: In a triangle of positive area, the edge value of the third vertex equals signed_area(), which is
;;   twice the area. So E >= 0 is the inner side.
(assert (not (= (edge_at px py qx qy rx ry) (signed_area px py qx qy rx ry))))

;; weakened inner_side: It equals twice signed_area(), in a triangle that has an area.
(assert (not (= (signed_area px py qx qy rx ry) 0.0)))
(assert (not (= (edge_at px py qx qy rx ry) (* 2.0 (signed_area px py qx qy rx ry)))))

;; claim bias_is_the_rule: For integers, E + bias >= 0 holds exactly if E > 0, or if E = 0 on a top or left edge.
(declare-const e Int)
(assert (not (= (>= (+ e (bias a b)) 0) (or (> e 0) (and (= e 0) (top_left a b))))))

;; weakened bias_is_the_rule: The same with a bias of -2.
(declare-const e Int)
(assert (not (= (>= (+ e (* 2 (bias a b))) 0) (or (> e 0) (and (= e 0) (top_left a b))))))

;; claim split_edge: If a triangle is split at a point of an edge, the two parts together cover the same samples, each
;;   exactly once. Positions are relative to the sample; m is the point, at a fraction u of the edge.
(declare-const mx Real) (declare-const my Real) (declare-const u Real)
(define-fun inside ((ux Real) (uy Real) (vx Real) (vy Real) (wx Real) (wy Real)) Bool
  (and (owns ux uy vx vy 0.0 0.0) (owns vx vy wx wy 0.0 0.0) (owns wx wy ux uy 0.0 0.0)))
(assert (> (signed_area px py qx qy rx ry) 0.0))
(assert (and (< 0.0 u) (< u 1.0)))
(assert (and (= mx (+ px (* u (- qx px)))) (= my (+ py (* u (- qy py))))))
(assert (not (= (inside px py qx qy rx ry) (xor (inside px py mx my rx ry) (inside mx my qx qy rx ry)))))

;; weakened split_edge: The same for a point off the edge, such as a T-junction whose vertex is snapped.
(declare-const mx Real) (declare-const my Real)
(define-fun inside ((ux Real) (uy Real) (vx Real) (vy Real) (wx Real) (wy Real)) Bool
  (and (owns ux uy vx vy 0.0 0.0) (owns vx vy wx wy 0.0 0.0) (owns wx wy ux uy 0.0 0.0)))
(assert (> (signed_area px py qx qy rx ry) 0.0))
(assert (not (= (inside px py qx qy rx ry) (xor (inside px py mx my rx ry) (inside mx my qx qy rx ry)))))

;; claim rotation: Rotating the order of a triangle's vertices keeps its three edges, so coverage does not change.
(define-fun inside ((ux Real) (uy Real) (vx Real) (vy Real) (wx Real) (wy Real)) Bool
  (and (owns ux uy vx vy sx sy) (owns vx vy wx wy sx sy) (owns wx wy ux uy sx sy)))
(assert (not (= (inside px py qx qy rx ry) (inside qx qy rx ry px py))))

;; weakened rotation: Reversing the order without orient() does not change coverage either.
(define-fun inside ((ux Real) (uy Real) (vx Real) (vy Real) (wx Real) (wy Real)) Bool
  (and (owns ux uy vx vy sx sy) (owns vx vy wx wy sx sy) (owns wx wy ux uy sx sy)))
(assert (not (= (inside px py qx qy rx ry) (inside qx qy px py rx ry))))
