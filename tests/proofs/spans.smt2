; Spans, by edges walked in binary fractions (line_lanes-inl.h) or by division (integer_spans.h). Theories:
; nonlinear real arithmetic, with a rounding to double as a factor 1 + e, |e| <= 2^-53; linear real arithmetic.
;
; In units of 2^-43 px, a step or start is a quotient of integers. It is computed with two roundings to double (the
; quotient of a power of two and dy, its product with dx or dx (s - p.y)) and one to a whole unit, which is off by at
; most 1. dx (s - p.y) exceeds 53 bits on the fine grid, so converting it is a third rounding.

(define-const unit Real 8796093022208.0)  ; units per px, 2^43
(define-fun ulp ((e Real)) Bool (between (- (/ 1.0 9007199254740992.0)) e (/ 1.0 9007199254740992.0)))
(define-const kUnitBits Int 43)           ; = kUnitBits of src/raster/spans/line_lanes-inl.h

;; claim step_off: Steps below 2^12 px per row are off by less than 575 units over 63 rows.
(declare-const exact Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const step Real)
(define-fun rounded () Real (* exact (+ 1.0 e1) (+ 1.0 e2)))
(assert (and (ulp e1) (ulp e2) (< (absr rounded) (* 4096.0 unit)) (<= (absr (- step rounded)) 1.0)))
(assert (not (< (absr (* 63.0 (- step exact))) 575.0)))

;; weakened step_off: They are off by less than 575 units over 64 rows.
(declare-const exact Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const step Real)
(define-fun rounded () Real (* exact (+ 1.0 e1) (+ 1.0 e2)))
(assert (and (ulp e1) (ulp e2) (< (absr rounded) (* 4096.0 unit)) (<= (absr (- step rounded)) 1.0)))
(assert (and (= e1 e2) (= e1 (/ 1.0 9007199254740992.0))))
(assert (not (< (absr (* 64.0 (- step exact))) 575.0)))

;; claim start_off: A start within 2^18 + 2^15 px of the vertex is off by less than 870 units.
(declare-const exact Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const e3 Real)
(declare-const start Real)
(define-fun rounded () Real (* exact (+ 1.0 e1) (+ 1.0 e2) (+ 1.0 e3)))
(assert (and (ulp e1) (ulp e2) (ulp e3) (<= (absr exact) (* 294912.0 unit)) (<= (absr (- start rounded)) 1.0)))
(assert (not (< (absr (- start exact)) 870.0)))

;; weakened start_off: So is a start within 2^18 + 2^17 px.
(declare-const exact Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const e3 Real)
(declare-const start Real)
(define-fun rounded () Real (* exact (+ 1.0 e1) (+ 1.0 e2) (+ 1.0 e3)))
(assert (and (ulp e1) (ulp e2) (ulp e3) (<= (absr exact) (* 393216.0 unit)) (<= (absr (- start rounded)) 1.0)))
(assert (and (= e1 e2) (= e2 e3) (= e1 (/ 1.0 9007199254740992.0))))
(assert (not (< (absr (- start exact)) 870.0)))

;; claim ceiling: On the coarse grid, v = n + r / d px, d = 256 |dy| <= 2^31. Where u lies within 1500 units of v, the
;;   floor of u + 1 px - 2^11 units is the ceiling of v: n if r is 0, n + 1 if not.
(declare-const n Real) (declare-const r Real) (declare-const d Real) (declare-const u Real)
(assert (and (>= d 1.0) (<= d 2147483648.0) (or (= r 0.0) (between 1.0 r (- d 1.0)))))
(assert (< (absr (- u (* unit (+ n (/ r d))))) 1500.0))
(define-fun w () Real (- (+ u unit) 2048.0))
(define-fun pixel () Real (ite (= r 0.0) n (+ n 1.0)))
(assert (not (and (<= (* unit pixel) w) (< w (* unit (+ pixel 1.0))))))

;; weakened ceiling: The same without the 2^11 units.
(declare-const n Real) (declare-const r Real) (declare-const d Real) (declare-const u Real)
(assert (and (>= d 1.0) (<= d 2147483648.0) (or (= r 0.0) (between 1.0 r (- d 1.0)))))
(assert (< (absr (- u (* unit (+ n (/ r d))))) 1500.0))
(define-fun w () Real (+ u unit))
(define-fun pixel () Real (ite (= r 0.0) n (+ n 1.0)))
(assert (not (and (<= (* unit pixel) w) (< w (* unit (+ pixel 1.0))))))

;; claim near_ceiling: On any grid, where u lies within 1500 units of v, the floor p of u + 1 px - 2^11 units is the
;;   ceiling n of v if the sample of pixel p is not left of the edge (p >= v). Else p + 1 is.
(declare-const v Real) (declare-const n Int) (declare-const u Real) (declare-const p Int)
(assert (and (< (- (to_real n) 1.0) v) (<= v (to_real n)) (< (absr (- u (* unit v))) 1500.0)))
(define-fun w () Real (- (+ u unit) 2048.0))
(assert (and (<= (* unit (to_real p)) w) (< w (* unit (to_real (+ p 1))))))
(assert (not (= n (ite (>= (to_real p) v) p (+ p 1)))))

;; weakened near_ceiling: The same without the 2^11 units.
(declare-const v Real) (declare-const n Int) (declare-const u Real) (declare-const p Int)
(assert (and (< (- (to_real n) 1.0) v) (<= v (to_real n)) (< (absr (- u (* unit v))) 1500.0)))
(define-fun w () Real (+ u unit))
(assert (and (<= (* unit (to_real p)) w) (< w (* unit (to_real (+ p 1))))))
(assert (not (= n (ite (>= (to_real p) v) p (+ p 1)))))

;; claim side_of_sample: The sample s of a pixel is not left of an edge's crossing with its row, at x, exactly if an
;;   edge that goes up, on the triangle's left, owns the sample, or if one that goes down, on its right, does not.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const sx Real) (declare-const sy Real) (declare-const x Real)
(assert (not (= py qy)))
(assert (= (* (- x px) (- qy py)) (* (- sy py) (- qx px))))
(assert (not (= (>= sx x) (ite (> py qy) (owns px py qx qy sx sy) (not (owns px py qx qy sx sy))))))

;; weakened side_of_sample: The same for samples that are right of the crossing.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const sx Real) (declare-const sy Real) (declare-const x Real)
(assert (not (= py qy)))
(assert (= (* (- x px) (- qy py)) (* (- sy py) (- qx px))))
(assert (not (= (> sx x) (ite (> py qy) (owns px py qx qy sx sy) (not (owns px py qx qy sx sy))))))

;; claim side_fits: A shifted edge value (rule 5) at a sample of the image, stepped to any pixel where a line may be
;;   (within 2^20 px), fits 64 bits.
(declare-const value Real) (declare-const a Real) (declare-const pixels Real)
(assert (between (- (to_real kMaxEdge_q30)) (* 32768.0 value) (to_real kMaxEdge_q30)))
(assert (and (between (- (to_real two30)) a (to_real two30)) (between (- 1048576.0) pixels 1048576.0)))
(assert (not (int64r (+ value (* a pixels)))))

;; weakened side_fits: It fits 48 bits.
(declare-const value Real) (declare-const a Real) (declare-const pixels Real)
(assert (between (- (to_real kMaxEdge_q30)) (* 32768.0 value) (to_real kMaxEdge_q30)))
(assert (and (= a (to_real two30)) (between (- 1048576.0) pixels 1048576.0)))
(assert (not (between (- 140737488355328.0) (+ value (* a pixels)) 140737488355327.0)))

;; claim far_starts: A line that starts more than 2^18 + 2^15 px right of a vertex, which is at most 2^15 px from the
;;   tile, stays right of the tile for 63 rows of less than 2^12 px. It also does if its start is clamped to 2^18 +
;;   2^17 px. On the left the same holds by symmetry. In px.
(declare-const vertex Real) (declare-const start Real) (declare-const way Real)
(assert (and (>= vertex (- 32768.0)) (> start 294912.0) (> way (- (* 63.0 4096.0)))))
(assert (not (and (> (+ vertex start way) 64.0) (> (+ vertex (minr start 393216.0) way) 64.0))))

;; weakened far_starts: It stays right of the tile for 64 rows.
(declare-const vertex Real) (declare-const start Real) (declare-const way Real)
(assert (and (>= vertex (- 32768.0)) (> start 294912.0) (> way (- (* 64.0 4096.0)))))
(assert (not (and (> (+ vertex start way) 64.0) (> (+ vertex (minr start 393216.0) way) 64.0))))

;; claim far_starts_in_bands: Such a line stays right of a band of 2^14 px for 31 rows.
(declare-const vertex Real) (declare-const start Real) (declare-const way Real)
(assert (and (>= vertex (- 32768.0)) (> start 294912.0) (> way (- (* 31.0 4096.0)))))
(assert (not (and (> (+ vertex start way) 16384.0) (> (+ vertex (minr start 393216.0) way) 16384.0))))

;; weakened far_starts_in_bands: It stays right of the band for 63 rows.
(declare-const vertex Real) (declare-const start Real) (declare-const way Real)
(assert (and (>= vertex (- 32768.0)) (> start 294912.0) (> way (- (* 63.0 4096.0)))))
(assert (not (and (> (+ vertex start way) 16384.0) (> (+ vertex (minr start 393216.0) way) 16384.0))))

;; claim sums_fit: The sum of start, steps, the distance from vertex to tile and the 1 px for rounding is less than
;;   2^63 units.
(declare-const vertex Real) (declare-const start Real) (declare-const way Real)
(assert (and (<= (absr vertex) 32768.0) (<= (absr start) 393216.0) (<= (absr way) (* 63.0 4096.0))))
(assert (not (int64r (* unit (+ vertex start way 1.0)))))

;; weakened sums_fit: The same for starts up to 2^19 + 2^18 px.
(declare-const vertex Real) (declare-const start Real) (declare-const way Real)
(assert (and (<= (absr vertex) 32768.0) (<= (absr start) 786432.0) (<= (absr way) (* 63.0 4096.0))))
(assert (not (int64r (* unit (+ vertex start way 1.0)))))

;; claim flat_edges: An edge in the guard band that moves 2^12 px per row or more is at most 8 px high.
(declare-const dx Real) (declare-const dy Real)
(assert (and (<= (absr dx) (to_real two30)) (> dy 0.0) (>= (absr dx) (* 4096.0 dy))))
(assert (not (<= dy (* 8.0 32768.0))))

;; weakened flat_edges: It is at most 7 px high.
(declare-const dx Real) (declare-const dy Real)
(assert (and (<= (absr dx) (to_real two30)) (> dy 0.0) (>= (absr dx) (* 4096.0 dy))))
(assert (not (<= dy (* 7.0 32768.0))))

;; claim walk_numerator: The numerator of first_right_of() fits 64 bits: it stays below 2^61.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real) (declare-const s Real)
(assert (and (in_guard px) (in_guard py) (in_guard qx) (in_guard qy) (in_guard s) (< py qy)))
(define-fun numerator () Real
  (+ (* (- px 16384.0) (- qy py)) (* (- s py) (- qx px)) (* 32768.0 (- qy py)) (- 1.0)))
(assert (not (between (- (to_real two61)) numerator (to_real two61))))

;; weakened walk_numerator: It stays below 2^59.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real) (declare-const s Real)
(assert (and (in_guard px) (in_guard py) (in_guard qx) (in_guard qy) (in_guard s) (< py qy)))
(define-fun numerator () Real
  (+ (* (- px 16384.0) (- qy py)) (* (- s py) (- qx px)) (* 32768.0 (- qy py)) (- 1.0)))
(assert (and (= px 0.0) (= py (- 536870912.0))))
(assert (not (between (- 576460752303423488.0) numerator 576460752303423488.0)))
