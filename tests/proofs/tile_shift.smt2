; Rule 5: a tile steps the biased edge value, shifted right by the bits of the grid, in 32 bits. Theories: linear
; integer arithmetic for the shift; nonlinear real arithmetic for the width.

(declare-const is_fine Bool)  ; 15 bits; else 8
(define-fun pixels ((k Int)) Int (ite is_fine (* kPixel_q15 k) (* 256 k)))
(define-fun shifted ((e Int)) Int (ite is_fine (div e kPixel_q15) (div e 256)))

;; claim steps_commute: Shifting and stepping commute: floor((E + 2^15 k) / 2^15) = floor(E / 2^15) + k.
(declare-const e Int) (declare-const k Int)
(assert (not (= (shifted (+ e (pixels k))) (+ (shifted e) k))))

;; weakened steps_commute: So do steps of half a pixel.
(declare-const e Int) (declare-const k Int)
(assert (not (= (shifted (+ e (div (pixels k) 2))) (+ (shifted e) (div k 2)))))

;; claim shifted_sign: The shifted value is negative exactly where the full one is, after any number of steps.
(declare-const e Int) (declare-const k Int)
(assert (not (= (< (+ e (pixels k)) 0) (< (+ (shifted e) k) 0))))

;; weakened shifted_sign: It is zero exactly where the full one is.
(declare-const e Int) (declare-const k Int)
(assert (not (= (= (+ e (pixels k)) 0) (= (+ (shifted e) k) 0))))

;; claim bias_then_shift: If the bias is added before the shift, the shifted value decides as the biased value does.
(declare-const e Int) (declare-const k Int) (declare-const bias_of_edge Int)
(assert (or (= bias_of_edge 0) (= bias_of_edge (- 1))))
(assert (not (= (>= (+ (shifted (+ e bias_of_edge)) k) 0) (>= (+ e (pixels k) bias_of_edge) 0))))

;; weakened bias_then_shift: The same if the bias is added after the shift.
(declare-const e Int) (declare-const k Int) (declare-const bias_of_edge Int)
(assert (or (= bias_of_edge 0) (= bias_of_edge (- 1))))
(assert (not (= (>= (+ (shifted e) bias_of_edge k) 0) (>= (+ e (pixels k) bias_of_edge) 0))))

;; claim crossed_box: In a box with a pixel on either side of the edge, the shifted values are at most their range away
;;   from zero. (u, v) is any pixel, f the shifted value at the first, (i, j) a pixel inside and (k, l) one outside.
(declare-const a Real) (declare-const b Real) (declare-const f Real)
(declare-const last_x Real) (declare-const last_y Real)
(declare-const i Real) (declare-const j Real) (declare-const k Real) (declare-const l Real)
(declare-const u Real) (declare-const v Real)
(define-fun in_box ((x Real) (y Real)) Bool (and (between 0.0 x last_x) (between 0.0 y last_y)))
(assert (and (in_box i j) (in_box k l) (in_box u v)))
(define-fun at ((x Real) (y Real)) Real (+ f (* x a) (* y b)))
(define-fun range () Real (+ (* last_x (absr a)) (* last_y (absr b))))
(assert (and (>= (at i j) 0.0) (< (at k l) 0.0)))
(assert (not (between (- range) (at u v) range)))

;; weakened crossed_box: The same if all pixels are inside.
(declare-const a Real) (declare-const b Real) (declare-const f Real)
(declare-const last_x Real) (declare-const last_y Real)
(declare-const u Real) (declare-const v Real)
(define-fun in_box ((x Real) (y Real)) Bool (and (between 0.0 x last_x) (between 0.0 y last_y)))
(assert (in_box u v))
(define-fun at ((x Real) (y Real)) Real (+ f (* x a) (* y b)))
(define-fun range () Real (+ (* last_x (absr a)) (* last_y (absr b))))
(assert (and (>= (at 0.0 0.0) 0.0) (>= (at last_x 0.0) 0.0) (>= (at 0.0 last_y) 0.0) (>= (at last_x last_y) 0.0)))
(assert (not (between (- range) (at u v) range)))

;; claim coarse_tiles_fit: On the coarse grid, where steps are at most 2^23, the range and one more step are at most
;;   2^30.
(declare-const a Real) (declare-const b Real)
(assert (and (between (- 8388608.0) a 8388608.0) (between (- 8388608.0) b 8388608.0)))
(assert (not (<= (+ (* 63.0 (+ (absr a) (absr b))) (maxr (absr a) (absr b))) (to_real two30))))

;; weakened coarse_tiles_fit: They are with steps up to 2^24.
(declare-const a Real) (declare-const b Real)
(assert (and (between (- 16777216.0) a 16777216.0) (between (- 16777216.0) b 16777216.0)))
(assert (not (<= (+ (* 63.0 (+ (absr a) (absr b))) (maxr (absr a) (absr b))) (to_real two30))))

;; claim short_edges_fit: An edge is not long if its range over the box, which has whole blocks, is below 2^31. Then the
;;   values in the box, the rise in a block and the range over a block fit 32 bits.
(declare-const a Real) (declare-const b Real) (declare-const value Real)
(declare-const last_x Real) (declare-const last_y Real)
(define-fun range () Real (+ (* last_x (absr a)) (* last_y (absr b))))
(assert (and (>= last_x 3.0) (>= last_y 3.0) (< range (to_real two31)) (between (- range) value range)))
(define-fun rise () Real (* 3.0 (+ (maxr a 0.0) (maxr b 0.0))))
(assert (not (and (int32r value) (int32r rise) (int32r (* 3.0 (+ (absr a) (absr b)))))))

;; weakened short_edges_fit: The same in boxes narrower than a block.
(declare-const a Real) (declare-const b Real) (declare-const value Real)
(declare-const last_x Real) (declare-const last_y Real)
(define-fun range () Real (+ (* last_x (absr a)) (* last_y (absr b))))
(assert (and (>= last_x 1.0) (>= last_y 3.0) (< range (to_real two31)) (between (- range) value range)))
(define-fun rise () Real (* 3.0 (+ (maxr a 0.0) (maxr b 0.0))))
(assert (not (and (int32r value) (int32r rise) (int32r (* 3.0 (+ (absr a) (absr b)))))))

;; claim long_edges_are_pairs: If start and steps of a linear function are split to 2^7 upper + lower, so are its
;;   values.
(declare-const x Int) (declare-const y Int)
(declare-const f_upper Int) (declare-const a_upper Int) (declare-const b_upper Int)
(declare-const f_lower Int) (declare-const a_lower Int) (declare-const b_lower Int)
(define-fun pair ((upper Int) (lower Int)) Int (+ (* 128 upper) lower))
(define-fun at ((f Int) (a Int) (b Int)) Int (+ f (* x a) (* y b)))
(assert (not (= (pair (at f_upper a_upper b_upper) (at f_lower a_lower b_lower))
                (at (pair f_upper f_lower) (pair a_upper a_lower) (pair b_upper b_lower)))))

;; weakened long_edges_are_pairs: The same if the lower part of the start is dropped.
(declare-const x Int) (declare-const y Int)
(declare-const f_upper Int) (declare-const a_upper Int) (declare-const b_upper Int)
(declare-const f_lower Int) (declare-const a_lower Int) (declare-const b_lower Int)
(define-fun pair ((upper Int) (lower Int)) Int (+ (* 128 upper) lower))
(define-fun at ((f Int) (a Int) (b Int)) Int (+ f (* x a) (* y b)))
(assert (= x y 1))
(assert (not (= (pair (at f_upper a_upper b_upper) (at 0 a_lower b_lower))
                (at (pair f_upper f_lower) (pair a_upper a_lower) (pair b_upper b_lower)))))

;; claim long_edges_carry: The lower part of a value in a tile is from 0 to 127 (1 + 63 + 63). So the carry is from 0 to
;;   kMostCarry, and upper part and carry together have the value's sign.
(declare-const x Real) (declare-const y Real)
(declare-const f_lower Real) (declare-const a_lower Real) (declare-const b_lower Real)
(declare-const upper Int) (declare-const lower Int)
(assert (and (between 0.0 x 63.0) (between 0.0 y 63.0)))
(assert (and (between 0.0 f_lower 127.0) (between 0.0 a_lower 127.0) (between 0.0 b_lower 127.0)))
(assert (= (to_real lower) (+ f_lower (* x a_lower) (* y b_lower))))
(define-fun carry () Int (div lower 128))
(assert (not (and (<= 0 carry) (<= carry 126) (= (< (+ upper carry) 0) (< (+ (* 128 upper) lower) 0)))))

;; weakened long_edges_carry: The carry is at most 63.
(declare-const x Real) (declare-const y Real)
(declare-const f_lower Real) (declare-const a_lower Real) (declare-const b_lower Real)
(declare-const lower Int)
(assert (and (between 0.0 x 63.0) (between 0.0 y 63.0)))
(assert (and (between 0.0 f_lower 127.0) (between 0.0 a_lower 127.0) (between 0.0 b_lower 127.0)))
(assert (= (to_real lower) (+ f_lower (* x a_lower) (* y b_lower))))
(assert (not (<= (div lower 128) 63)))

;; claim long_edges_fit: The upper part of a value in a crossed tile fits 32 bits, with the rise and the range over a
;;   block, which include the carry.
(declare-const a Real) (declare-const b Real) (declare-const value Real)
(declare-const upper Real) (declare-const lower Real) (declare-const block Real)
(define-fun range () Real (* 63.0 (+ (absr a) (absr b))))
(assert (and (between (- (to_real two30)) a (to_real two30)) (between (- (to_real two30)) b (to_real two30))))
(assert (and (between (- range) value range) (between 0.0 lower 16129.0) (= value (+ (* 128.0 upper) lower))))
(assert (between 0.0 block (+ 126.0 (* 3.0 (+ 2.0 (/ (absr a) 128.0) (/ (absr b) 128.0))))))
(assert (not (and (int32r upper) (int32r (+ upper block)) (int32r (- upper block)))))

;; weakened long_edges_fit: So does the upper part of twice the value.
(declare-const a Real) (declare-const b Real) (declare-const value Real)
(declare-const upper Real) (declare-const lower Real)
(define-fun range () Real (* 63.0 (+ (absr a) (absr b))))
(assert (and (= a (to_real two30)) (= b a)))
(assert (and (between (- range) value range) (between 0.0 lower 16129.0) (= (* 4.0 value) (+ (* 128.0 upper) lower))))
(assert (not (int32r upper)))

;; claim two_words: In frame_edges.cpp, adding pairs 2^31 high + low, 0 <= low < 2^31, word by word with the carry gives
;;   the pair of the sum. Its sign is that of `high`.
(declare-const high Int) (declare-const low Int) (declare-const down_high Int) (declare-const down_low Int)
(define-fun is_low ((v Int)) Bool (and (<= 0 v) (< v two31)))
(assert (and (is_low low) (is_low down_low)))
(define-fun carry () Int (ite (< (signed32 (+ low down_low)) 0) 1 0))
(define-fun new_low () Int (mod (+ low down_low) two31))
(define-fun new_high () Int (+ high down_high carry))
(define-fun sum () Int (+ (* two31 (+ high down_high)) low down_low))
(assert (not (and (is_low new_low) (= sum (+ (* two31 new_high) new_low)) (= (< sum 0) (< new_high 0)))))

;; weakened two_words: The same without the carry.
(declare-const high Int) (declare-const low Int) (declare-const down_high Int) (declare-const down_low Int)
(define-fun is_low ((v Int)) Bool (and (<= 0 v) (< v two31)))
(assert (and (is_low low) (is_low down_low)))
(define-fun new_low () Int (mod (+ low down_low) two31))
(define-fun sum () Int (+ (* two31 (+ high down_high)) low down_low))
(assert (not (= sum (+ (* two31 (+ high down_high)) new_low))))

;; claim clamped_edges: In frame_edges.cpp, a first value clamped to 2^30 keeps the sign of each value in a depth cell
;;   and up to 15 px beside it, at most 79 px to the side and 32 down, and no value exceeds 32 bits, for steps of at
;;   most 2^23.
(declare-const f Real) (declare-const a Real) (declare-const b Real) (declare-const x Real) (declare-const y Real)
(assert (and (between (- 8388608.0) a 8388608.0) (between (- 8388608.0) b 8388608.0)))
(assert (and (between (- 79.0) x 79.0) (between 0.0 y 32.0)))
(define-fun clamped () Real (minr (maxr f (- (to_real two30))) (to_real two30)))
(define-fun way () Real (+ (* x a) (* y b)))
(assert (not (and (= (< (+ f way) 0.0) (< (+ clamped way) 0.0)) (int32r (+ clamped way)))))

;; weakened clamped_edges: The same for steps of at most 2^24.
(declare-const f Real) (declare-const a Real) (declare-const b Real) (declare-const x Real) (declare-const y Real)
(assert (and (between (- 16777216.0) a 16777216.0) (between (- 16777216.0) b 16777216.0)))
(assert (and (between (- 79.0) x 79.0) (between 0.0 y 32.0)))
(define-fun clamped () Real (minr (maxr f (- (to_real two30))) (to_real two30)))
(define-fun way () Real (+ (* x a) (* y b)))
(assert (not (= (< (+ f way) 0.0) (< (+ clamped way) 0.0))))

;; claim lower_half_is_enough: If a shifted value fits 32 bits, its lower 32 bits, signed, equal it.
(declare-const v Int)
(assert (int32 v))
(assert (not (= (signed32 (mod v two64)) v)))

;; weakened lower_half_is_enough: The same for a value that fits 33 bits.
(declare-const v Int)
(assert (and (<= (- two32) v) (< v two32)))
(assert (not (= (signed32 (mod v two64)) v)))
