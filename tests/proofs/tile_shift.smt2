; Rule 5: a tile steps the biased edge value, shifted right by 8, in 32 bits. Theories: linear integer arithmetic for
; the shift; nonlinear real arithmetic for the width.

;; claim steps_commute: Shifting and stepping commute: floor((E + 256 k) / 256) = floor(E / 256) + k.
(declare-const e Int) (declare-const k Int)
(assert (not (= (div (+ e (* kPixel_q15 k)) kPixel_q15) (+ (div e kPixel_q15) k))))

;; weakened steps_commute: So do steps of half a pixel.
(declare-const e Int) (declare-const k Int)
(assert (not (= (div (+ e (* kHalf_q15 k)) kPixel_q15) (+ (div e kPixel_q15) (div k 2)))))

;; claim shifted_sign: The shifted value is negative exactly where the full one is, after any number of steps.
(declare-const e Int) (declare-const k Int)
(assert (not (= (< (+ e (* kPixel_q15 k)) 0) (< (+ (div e kPixel_q15) k) 0))))

;; weakened shifted_sign: It is zero exactly where the full one is.
(declare-const e Int) (declare-const k Int)
(assert (not (= (= (+ e (* kPixel_q15 k)) 0) (= (+ (div e kPixel_q15) k) 0))))

;; claim bias_then_shift: If the bias is added before the shift, the shifted value decides as the biased value does.
(declare-const e Int) (declare-const k Int) (declare-const bias_of_edge Int)
(assert (or (= bias_of_edge 0) (= bias_of_edge (- 1))))
(assert (not (= (>= (+ (div (+ e bias_of_edge) kPixel_q15) k) 0) (>= (+ e (* kPixel_q15 k) bias_of_edge) 0))))

;; weakened bias_then_shift: The same if the bias is added after the shift.
(declare-const e Int) (declare-const k Int) (declare-const bias_of_edge Int)
(assert (or (= bias_of_edge 0) (= bias_of_edge (- 1))))
(assert (not (= (>= (+ (div e kPixel_q15) bias_of_edge k) 0) (>= (+ e (* kPixel_q15 k) bias_of_edge) 0))))

;; claim crossed_tile_fits: In a tile of 64 x 64 pixels with a pixel on either side of the edge, the shifted values
;;   stay within 2^30 of zero, at all pixels and one step beyond the last. (u, v) is any pixel, f the shifted value at
;;   the first, (i, j) a pixel inside and (k, l) one outside.
(declare-const a Real) (declare-const b Real) (declare-const f Real)
(declare-const i Real) (declare-const j Real) (declare-const k Real) (declare-const l Real)
(declare-const u Real) (declare-const v Real)
(define-fun in_tile ((p Real)) Bool (between 0.0 p 63.0))
(assert (and (between (- 8388608.0) a 8388608.0) (between (- 8388608.0) b 8388608.0)))
(assert (and (in_tile i) (in_tile j) (in_tile k) (in_tile l) (in_tile u) (in_tile v)))
(define-fun at ((x Real) (y Real)) Real (+ f (* x a) (* y b)))
(assert (and (>= (at i j) 0.0) (< (at k l) 0.0)))
(assert (not (and (between (- 1056964608.0) (at u v) 1056964608.0)
                  (between (- 1073741824.0) (+ (at u v) a) 1073741824.0)
                  (between (- 1073741824.0) (+ (at u v) b) 1073741824.0))))

;; weakened crossed_tile_fits: The same in a tile of 256 x 256 pixels, within 32 bits.
(declare-const a Real) (declare-const b Real) (declare-const f Real)
(declare-const i Real) (declare-const j Real) (declare-const k Real) (declare-const l Real)
(declare-const u Real) (declare-const v Real)
(define-fun in_tile ((p Real)) Bool (between 0.0 p 255.0))
(assert (and (between (- 8388608.0) a 8388608.0) (between (- 8388608.0) b 8388608.0)))
(assert (and (in_tile i) (in_tile j) (in_tile k) (in_tile l) (in_tile u) (in_tile v)))
(define-fun at ((x Real) (y Real)) Real (+ f (* x a) (* y b)))
(assert (and (>= (at i j) 0.0) (< (at k l) 0.0)))
(assert (and (= a 8388608.0) (= b a)))
(assert (not (int32r (at u v))))

;; claim lower_half_is_enough: If a shifted value fits 32 bits, its lower 32 bits, signed, equal it.
(declare-const v Int)
(assert (int32 v))
(assert (not (= (signed32 (mod v two64)) v)))

;; weakened lower_half_is_enough: The same for a value that fits 33 bits.
(declare-const v Int)
(assert (and (<= (- two32) v) (< v two32)))
(assert (not (= (signed32 (mod v two64)) v)))
