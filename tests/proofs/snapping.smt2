; Rule 2: positions are rounded half to even (src/frontend/fixed.h). Theory: floating point.

;; claim round_half_even: Adding 1.5 2^23 to a float of at most 2^22 and taking the difference of the bits rounds it
;;   to an integer, half to even.
(declare-const bits (_ BitVec 32)) (declare-const sum (_ BitVec 32))
(define-fun v () Float32 ((_ to_fp 8 24) bits))
(define-fun rounder () Float32 ((_ to_fp 8 24) #x4B400000))
(assert (fp.leq (fp.abs v) ((_ to_fp 8 24) #x4A800000)))
(assert (= ((_ to_fp 8 24) sum) (fp.add RNE v rounder)))
(assert (not (= (bvsub sum #x4B400000) ((_ fp.to_sbv 32) RNE v))))

;; weakened round_half_even: The same for a float of at most 2^23.
(declare-const bits (_ BitVec 32)) (declare-const sum (_ BitVec 32))
(define-fun v () Float32 ((_ to_fp 8 24) bits))
(define-fun rounder () Float32 ((_ to_fp 8 24) #x4B400000))
(assert (fp.leq (fp.abs v) ((_ to_fp 8 24) #x4B000000)))
(assert (= ((_ to_fp 8 24) sum) (fp.add RNE v rounder)))
(assert (not (= (bvsub sum #x4B400000) ((_ fp.to_sbv 32) RNE v))))

;; claim clamped_in_guard: For every position except NaN, the float that snap() rounds lies in the guard band, and so
;;   does the integer.
(declare-const bits (_ BitVec 32))
(define-fun limit () Float32 ((_ to_fp 8 24) #x4A800000))
(define-fun scaled () Float32 (fp.mul RNE ((_ to_fp 8 24) bits) ((_ to_fp 8 24) #x43800000)))
(define-fun clamped () Float32
  (ite (fp.lt scaled (fp.neg limit)) (fp.neg limit) (ite (fp.lt limit scaled) limit scaled)))
(define-fun snapped () (_ BitVec 32) ((_ fp.to_sbv 32) RNE clamped))
(assert (not (fp.isNaN ((_ to_fp 8 24) bits))))
(assert (not (and (bvsle #xFFC00000 snapped) (bvsle snapped #x00400000))))

;; weakened clamped_in_guard: The same for NaN.
(declare-const bits (_ BitVec 32))
(define-fun limit () Float32 ((_ to_fp 8 24) #x4A800000))
(define-fun scaled () Float32 (fp.mul RNE ((_ to_fp 8 24) bits) ((_ to_fp 8 24) #x43800000)))
(define-fun clamped () Float32
  (ite (fp.lt scaled (fp.neg limit)) (fp.neg limit) (ite (fp.lt limit scaled) limit scaled)))
(assert (not (fp.leq (fp.abs clamped) limit)))
