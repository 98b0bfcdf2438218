; Spans, by edges walked in binary fractions (line_lanes-inl.h) or by division (integer_spans.h). Theories:
; nonlinear real arithmetic, with a rounding to double as a factor 1 + e, |e| <= 2^-53; linear real arithmetic.
;
; In units of 2^-43 px, a step or start is a quotient of integers, computed with two roundings to double (the quotient
; of 2^35 and dy, its product with an exact number) and one to a whole unit, which is off by at most 1.

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

;; claim start_off: A start within 2^18 + 2^15 px of the vertex is off by less than 650 units.
(declare-const exact Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const start Real)
(define-fun rounded () Real (* exact (+ 1.0 e1) (+ 1.0 e2)))
(assert (and (ulp e1) (ulp e2) (<= (absr exact) (* 294912.0 unit)) (<= (absr (- start rounded)) 1.0)))
(assert (not (< (absr (- start exact)) 650.0)))

;; weakened start_off: So is a start within 2^18 + 2^17 px.
(declare-const exact Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const start Real)
(define-fun rounded () Real (* exact (+ 1.0 e1) (+ 1.0 e2)))
(assert (and (ulp e1) (ulp e2) (<= (absr exact) (* 393216.0 unit)) (<= (absr (- start rounded)) 1.0)))
(assert (and (= e1 e2) (= e1 (/ 1.0 9007199254740992.0))))
(assert (not (< (absr (- start exact)) 650.0)))

;; claim ceiling: Where v = n + r / d px, d = 256 |dy| <= 2^31, and u lies within 1300 units of v, the floor of u + 1
;;   px - 2^11 units is the ceiling of v: n if r is 0, n + 1 if not.
(declare-const n Real) (declare-const r Real) (declare-const d Real) (declare-const u Real)
(assert (and (>= d 1.0) (<= d 2147483648.0) (or (= r 0.0) (between 1.0 r (- d 1.0)))))
(assert (< (absr (- u (* unit (+ n (/ r d))))) 1300.0))
(define-fun w () Real (- (+ u unit) 2048.0))
(define-fun pixel () Real (ite (= r 0.0) n (+ n 1.0)))
(assert (not (and (<= (* unit pixel) w) (< w (* unit (+ pixel 1.0))))))

;; weakened ceiling: The same without the 2^11 units.
(declare-const n Real) (declare-const r Real) (declare-const d Real) (declare-const u Real)
(assert (and (>= d 1.0) (<= d 2147483648.0) (or (= r 0.0) (between 1.0 r (- d 1.0)))))
(assert (< (absr (- u (* unit (+ n (/ r d))))) 1300.0))
(define-fun w () Real (+ u unit))
(define-fun pixel () Real (ite (= r 0.0) n (+ n 1.0)))
(assert (not (and (<= (* unit pixel) w) (< w (* unit (+ pixel 1.0))))))

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
(assert (and (<= (absr dx) 8388608.0) (> dy 0.0) (>= (absr dx) (* 4096.0 dy))))
(assert (not (<= dy 2048.0)))

;; weakened flat_edges: It is at most 7 px high.
(declare-const dx Real) (declare-const dy Real)
(assert (and (<= (absr dx) 8388608.0) (> dy 0.0) (>= (absr dx) (* 4096.0 dy))))
(assert (not (<= dy 1792.0)))

;; claim walk_numerator: The numerator of first_right_of() fits 64 bits with 15 to spare: it stays below 2^49.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real) (declare-const s Real)
(assert (and (in_guard px) (in_guard py) (in_guard qx) (in_guard qy) (in_guard s) (< py qy)))
(define-fun numerator () Real
  (+ (* (- px 128.0) (- qy py)) (* (- s py) (- qx px)) (* 256.0 (- qy py)) (- 1.0)))
(assert (not (between (- 562949953421312.0) numerator 562949953421312.0)))

;; weakened walk_numerator: It stays below 2^45.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real) (declare-const s Real)
(assert (and (in_guard px) (in_guard py) (in_guard qx) (in_guard qy) (in_guard s) (< py qy)))
(define-fun numerator () Real
  (+ (* (- px 128.0) (- qy py)) (* (- s py) (- qx px)) (* 256.0 (- qy py)) (- 1.0)))
(assert (and (= px 0.0) (= py (- 4194304.0))))
(assert (not (between (- 35184372088832.0) numerator 35184372088832.0)))
