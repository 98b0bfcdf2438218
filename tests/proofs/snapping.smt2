; Rule 2: positions are rounded half to even (src/frontend/fixed.h). Theory: floating point. With fewer than 15 subpixel
; bits, all numbers are multiplied by a power of two, which is exact.

;; claim round_half_even: Adding 1.5 2^37 to a position in the guard band, in px, and subtracting it rounds the position
;;   to 2^-15 px, half to even.
(declare-const px (_ BitVec 64))
(define-fun v () Float64 ((_ to_fp 11 53) px))
(define-fun rounder () Float64 ((_ to_fp 11 53) #x4248000000000000))
(define-fun units () Float64 ((_ to_fp 11 53) #x40E0000000000000))
(define-fun rounded () Float64 (fp.sub RNE (fp.add RNE v rounder) rounder))
(assert (fp.leq (fp.abs v) ((_ to_fp 11 53) #x40D0000000000000)))
(assert (not (fp.eq (fp.mul RNE rounded units) (fp.roundToIntegral RNE (fp.mul RNE v units)))))

;; weakened round_half_even: The same for a position of at most 2^38 px.
(declare-const px (_ BitVec 64))
(define-fun v () Float64 ((_ to_fp 11 53) px))
(define-fun rounder () Float64 ((_ to_fp 11 53) #x4248000000000000))
(define-fun units () Float64 ((_ to_fp 11 53) #x40E0000000000000))
(define-fun rounded () Float64 (fp.sub RNE (fp.add RNE v rounder) rounder))
(assert (fp.leq (fp.abs v) ((_ to_fp 11 53) #x4250000000000000)))
(assert (not (fp.eq (fp.mul RNE rounded units) (fp.roundToIntegral RNE (fp.mul RNE v units)))))

;; claim clamped_in_guard: For every position except NaN, the number that snap() rounds lies in the guard band, and so
;;   does the integer.
(declare-const px (_ BitVec 64))
(define-fun limit () Float64 ((_ to_fp 11 53) #x40D0000000000000))
(define-fun v () Float64 ((_ to_fp 11 53) px))
(define-fun clamped () Float64 (ite (fp.lt v (fp.neg limit)) (fp.neg limit) (ite (fp.lt limit v) limit v)))
(define-fun snapped () (_ BitVec 32)
  ((_ fp.to_sbv 32) RNE (fp.mul RNE clamped ((_ to_fp 11 53) #x40E0000000000000))))
(assert (not (fp.isNaN v)))
(assert (not (and (bvsle #xE0000000 snapped) (bvsle snapped #x20000000))))

;; weakened clamped_in_guard: The same for NaN.
(declare-const px (_ BitVec 64))
(define-fun limit () Float64 ((_ to_fp 11 53) #x40D0000000000000))
(define-fun v () Float64 ((_ to_fp 11 53) px))
(define-fun clamped () Float64 (ite (fp.lt v (fp.neg limit)) (fp.neg limit) (ite (fp.lt limit v) limit v)))
(assert (not (fp.leq (fp.abs clamped) limit)))
