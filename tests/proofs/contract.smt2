; The contract's constants and functions (src/edgewise/contract.h), for the claims in the other files of this folder.
;
; The solver reasons about mathematical integers and reals, which never wrap. The code's 32-bit and 64-bit results are
; the same numbers wherever the claims show that every intermediate result fits. Where the code wraps on purpose, they
; are the same modulo a power of two (lanes.smt2, depth.smt2). Polynomials are stated over the reals, which contain
; the integers, because that theory is decidable. Roundings are stated over integers.
;
; `scripts/prove` puts this text before every other file, which has an introduction and sections. A section "claim
; NAME" asserts the premises and the negation of the claim: the solver must find that impossible. A section "weakened
; NAME" asserts the same for a deliberately false variant of the claim: the solver must find a counterexample.
;
; `scripts/prove` compares a constant whose comment begins with "=" with the named source. tests/raster/proofs_test.cpp
; compares the functions with those of contract.h, on many arguments.

(define-const kFineBits Int 15)            ; = kFineBits of src/edgewise/contract.h
(define-const kPixel_q15 Int 32768)        ; = kPixel_q15 of src/edgewise/contract.h
(define-const kHalf_q15 Int 16384)         ; = kHalf_q15 of src/edgewise/contract.h
(define-const kGuard_q15 Int 536870912)    ; = kGuard_q15 of src/edgewise/contract.h
(define-const kMaxImageSide Int 16384)     ; = kMaxImageSide of src/edgewise/contract.h
(define-const kMaxEdge_q30 Int 2305843009213693952) ; = kMaxEdge_q30 of src/edgewise/contract.h
(define-const kPlaneBits Int 31)           ; = kPlaneBits of src/edgewise/contract.h
(define-const kMaxTile Int 64)             ; = kMaxTile of src/edgewise/contract.h
(define-const kDepthCell Int 64)           ; = kDepthCell of src/edgewise/contract.h
(define-const kDepthHead Int 128)          ; = kDepthHead of src/edgewise/contract.h
(define-const kDepthClear Int 2147483647)  ; = kDepthClear of src/edgewise/contract.h
(define-const kDepthRange Int 2147483388)  ; = kDepthRange of src/edgewise/contract.h
(define-const kDepthError Int 34)          ; = kDepthError of src/edgewise/contract.h

(define-const two8 Int 256)
(define-const two16 Int 65536)
(define-const two24 Int 16777216)
(define-const two31 Int 2147483648)
(define-const two32 Int 4294967296)
(define-const two46 Int 70368744177664)
(define-const two53 Int 9007199254740992)
(define-const two54 Int 18014398509481984)
(define-const two60 Int 1152921504606846976)
(define-const two61 Int 2305843009213693952)
(define-const two63 Int 9223372036854775808)
(define-const two64 Int 18446744073709551616)

(define-fun int32 ((v Int)) Bool (and (<= (- two31) v) (< v two31)))
(define-fun int64 ((v Int)) Bool (and (<= (- two63) v) (< v two63)))
(define-fun int32r ((v Real)) Bool (and (<= (- (to_real two31)) v) (< v (to_real two31))))
(define-fun int64r ((v Real)) Bool (and (<= (- (to_real two63)) v) (< v (to_real two63))))
(define-fun signed32 ((v Int)) Int (- (mod (+ v two31) two32) two31)) ; the lower 32 bits, as a signed number
(define-fun between ((low Real) (v Real) (high Real)) Bool (and (<= low v) (<= v high)))
(define-fun maxr ((u Real) (v Real)) Real (ite (< u v) v u))
(define-fun minr ((u Real) (v Real)) Real (ite (< u v) u v))
(define-fun absr ((v Real)) Real (ite (< v 0.0) (- v) v))

; Rules 1 and 3. A coordinate or a sample of an image, in 2^-15 px.
(define-fun sample_q15 ((pixel Int)) Int (+ (* kPixel_q15 pixel) kHalf_q15))
(define-fun in_guard ((v Real)) Bool (between (- (to_real kGuard_q15)) v (to_real kGuard_q15)))
(define-fun pixel_in_image ((p Int)) Bool (and (<= 0 p) (< p kMaxImageSide)))

; Rule 4. The edge from p to q, without bias; make_edge() and Edge::at() add the bias.
(define-fun edge_a ((py Real) (qy Real)) Real (- py qy))
(define-fun edge_b ((px Real) (qx Real)) Real (- qx px))
(define-fun edge_at ((px Real) (py Real) (qx Real) (qy Real) (sx Real) (sy Real)) Real
  (+ (* (edge_a py qy) (- sx px)) (* (edge_b px qx) (- sy py))))
(define-fun top_left ((a Real) (b Real)) Bool (or (> a 0.0) (and (= a 0.0) (> b 0.0))))
(define-fun bias ((a Real) (b Real)) Int (ite (top_left a b) 0 (- 1)))
; E + bias >= 0 for an integer E (fill_rule.smt2 proves that), in a form that means the same to the reals.
(define-fun owns ((px Real) (py Real) (qx Real) (qy Real) (sx Real) (sy Real)) Bool
  (let ((e (edge_at px py qx qy sx sy)))
    (or (> e 0.0) (and (= e 0.0) (top_left (edge_a py qy) (edge_b px qx))))))

; signed_area(), and pixel_box() along an axis.
(define-fun signed_area ((x0 Real) (y0 Real) (x1 Real) (y1 Real) (x2 Real) (y2 Real)) Real
  (- (* (- x1 x0) (- y2 y0)) (* (- y1 y0) (- x2 x0))))
(define-fun first_sample ((c Int)) Int (div (+ c kHalf_q15 (- 1)) kPixel_q15))

; Rule 6. gradient(), before it wraps; the rounded step per pixel; and depth, before it wraps, at the middle pixel of a
; cell whose sample is (dx, dy) from the anchor, and at pixel (x, y) of the cell.
(define-fun gradient ((n Int) (area Int)) Int (div (* two31 n) area))
(define-fun depth_step ((g Int)) Int (div (+ g 32768) two16))
(define-fun depth_middle ((z Int) (gx Int) (gy Int) (dx Int) (dy Int)) Int
  (div (+ (* two31 z) 1073741824 (* gx dx) (* gy dy)) two31))
(define-fun depth_at ((z Int) (gx Int) (gy Int) (dx Int) (dy Int) (x Int) (y Int)) Int
  (+ (depth_middle z gx gy dx dy) (* (- x 32) (depth_step gx)) (* (- y 32) (depth_step gy))))
