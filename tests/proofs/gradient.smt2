; The gradient's division: a double estimates it, and a remainder corrects it. Theories: nonlinear real arithmetic,
; with a rounding to double as a factor 1 + e, |e| <= 2^-53 (no result is subnormal: a quotient that is not zero is
; at least 2^31 / 2^60); floating point for the rounding to an integer.
;
; The code computes the floor of true_q = 2^31 n / area, |n| <= 2^61, 0 < area <= 2^60 (guard_band.smt2,
; depth.smt2).

(define-fun ulp ((e Real)) Bool (between (- (/ 1.0 9007199254740992.0)) e (/ 1.0 9007199254740992.0)))

;; claim plain_estimate: In contract::gradient(), with three roundings (n and area to double, the quotient), an estimate
;;   below 2^51 is off by less than 0.76, and by less than 1.76 when truncated to an integer. So at most two corrections
;;   follow.
(declare-const true_q Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const e3 Real)
(declare-const q Real) (declare-const cut Real)
(assert (= (* q (+ 1.0 e2)) (* true_q (+ 1.0 e1) (+ 1.0 e3))))
(assert (and (ulp e1) (ulp e2) (ulp e3) (< (absr q) 2251799813685248.0)))
(assert (and (< (- cut) 1.0) (< cut 1.0)))
(assert (not (and (< (absr (- q true_q)) 0.76) (< (absr (- (- q cut) true_q)) 1.76))))

;; weakened plain_estimate: It is off by less than 0.74.
(declare-const true_q Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const e3 Real)
(declare-const q Real)
(assert (= (* q (+ 1.0 e2)) (* true_q (+ 1.0 e1) (+ 1.0 e3))))
(assert (and (ulp e1) (ulp e2) (ulp e3) (< (absr q) 2251799813685248.0)))
(assert (and (= e1 e3) (= e1 (/ 1.0 9007199254740992.0)) (= e2 (- e1))))
(assert (not (< (absr (- q true_q)) 0.74)))

;; claim plain_remainder: The remainder of such an estimate, and of each correction up to the floor, fits 64 bits,
;;   although 2^31 n and g area wrap.
(declare-const true_q Real) (declare-const g Real) (declare-const area Real)
(assert (and (>= area 1.0) (<= area (to_real two60)) (< (absr (- g true_q)) 1.76)))
(assert (not (between (- (/ (to_real two63) 2.0)) (- (* true_q area) (* g area)) (/ (to_real two63) 2.0))))

;; weakened plain_remainder: It fits 60 bits.
(declare-const true_q Real) (declare-const g Real) (declare-const area Real)
(assert (and (>= area 1.0) (<= area (to_real two60)) (< (absr (- g true_q)) 1.76)))
(assert (not (between (- (/ (to_real two60) 2.0)) (- (* true_q area) (* g area)) (/ (to_real two60) 2.0))))
(assert (= area (to_real two60)))

;; claim remainder_decides: Exactly one integer g has a remainder 2^31 n - g area in [0, area): the floor. Two
;;   integers are at least 1 apart; m is 2^31 n.
(declare-const m Real) (declare-const area Real) (declare-const g Real) (declare-const h Real)
(assert (and (> area 0.0) (<= 0.0 (- m (* g area))) (< (- m (* g area)) area)))
(assert (and (<= 0.0 (- m (* h area))) (< (- m (* h area)) area)))
(assert (not (< (absr (- g h)) 1.0)))

;; weakened remainder_decides: The same for [0, area].
(declare-const m Real) (declare-const area Real) (declare-const g Real) (declare-const h Real)
(assert (and (> area 0.0) (<= 0.0 (- m (* g area))) (<= (- m (* g area)) area)))
(assert (and (<= 0.0 (- m (* h area))) (<= (- m (* h area)) area)))
(assert (not (< (absr (- g h)) 1.0)))

;; claim lane_estimate: In depth_lanes-inl.h, with four roundings (n and area to double, 2^31 / area, the
;;   product), an estimate below 2^49 is off by less than 1/3, and by less than 5/6 when rounded to an integer. On the
;;   coarse grid, the area needs no rounding.
(declare-const true_q Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const e3 Real)
(declare-const e4 Real) (declare-const q Real) (declare-const g Real)
(assert (= (* q (+ 1.0 e2)) (* true_q (+ 1.0 e1) (+ 1.0 e3) (+ 1.0 e4))))
(assert (and (ulp e1) (ulp e2) (ulp e3) (ulp e4) (< (absr q) 562949953421312.0) (<= (absr (- g q)) 0.5)))
(assert (not (and (< (absr (- q true_q)) (/ 1.0 3.0)) (< (absr (- g true_q)) (/ 5.0 6.0)))))

;; weakened lane_estimate: The same below 2^50.
(declare-const true_q Real) (declare-const e1 Real) (declare-const e2 Real) (declare-const e3 Real)
(declare-const e4 Real) (declare-const q Real) (declare-const g Real)
(assert (= (* q (+ 1.0 e2)) (* true_q (+ 1.0 e1) (+ 1.0 e3) (+ 1.0 e4))))
(assert (and (ulp e1) (ulp e2) (ulp e3) (ulp e4) (< (absr q) 1125899906842624.0) (<= (absr (- g q)) 0.5)))
(assert (and (= e1 e3) (= e3 e4) (= e1 (/ 1.0 9007199254740992.0)) (= e2 (- e1))))
(assert (not (< (absr (- q true_q)) (/ 1.0 3.0))))

;; claim lane_correction: If an integer is within 5/6 of the exact quotient, its remainder fits 64 bits. The sign of
;;   the remainder decides whether the integer is the floor, or whether the floor is the one below, whose remainder is
;;   larger by one area.
(declare-const rest Int) (declare-const area Int)
(assert (and (> area 0) (<= area two60)))
(assert (and (< (* 6 rest) (* 5 area)) (> (* 6 rest) (- (* 5 area)))))
(define-fun corrected () Int (ite (< rest 0) (+ rest area) rest))
(assert (not (and (<= 0 corrected) (< corrected area) (int64 rest))))

;; weakened lane_correction: The same for an integer within 5/4.
(declare-const rest Int) (declare-const area Int)
(assert (and (> area 0) (<= area two60)))
(assert (and (< (* 4 rest) (* 5 area)) (> (* 4 rest) (- (* 5 area)))))
(define-fun corrected () Int (ite (< rest 0) (+ rest area) rest))
(assert (not (and (<= 0 corrected) (< corrected area) (int64 rest))))

;; claim adding_rounds: Adding 1.5 2^52 to a double below 2^49 and taking the difference of the bits rounds it to an
;;   integer, half to even.
(declare-const bits (_ BitVec 64)) (declare-const sum (_ BitVec 64))
(define-fun q () Float64 ((_ to_fp 11 53) bits))
(define-fun rounder () Float64 ((_ to_fp 11 53) #x4338000000000000))
(assert (fp.lt (fp.abs q) ((_ to_fp 11 53) #x4300000000000000)))
(assert (= ((_ to_fp 11 53) sum) (fp.add RNE q rounder)))
(assert (not (= (bvsub sum #x4338000000000000) ((_ fp.to_sbv 64) RNE q))))

;; weakened adding_rounds: The same below 2^52.
(declare-const bits (_ BitVec 64)) (declare-const sum (_ BitVec 64))
(define-fun q () Float64 ((_ to_fp 11 53) bits))
(define-fun rounder () Float64 ((_ to_fp 11 53) #x4338000000000000))
(assert (fp.lt (fp.abs q) ((_ to_fp 11 53) #x4330000000000000)))
(assert (= ((_ to_fp 11 53) sum) (fp.add RNE q rounder)))
(assert (not (= (bvsub sum #x4338000000000000) ((_ fp.to_sbv 64) RNE q))))
