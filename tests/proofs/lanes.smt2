; Products of fixed size in the SIMD set-up (triangle_lanes-inl.h, depth_lanes-inl.h). Theories: integer
; arithmetic and reals for widths, polynomial identities over integers for products, bit-vectors for splits and flips.

;; claim product_32_32: The product of two 32-bit numbers fits 64 bits.
(declare-const a Real) (declare-const b Real)
(assert (and (int32r a) (int32r b)))
(assert (not (int64r (* a b))))

;; weakened product_32_32: So does twice that product.
(declare-const a Real) (declare-const b Real)
(assert (and (int32r a) (int32r b)))
(assert (not (int64r (* 2.0 a b))))

;; claim split_rounds: A 64-bit number is low + 2^32 high modulo 2^64, where low is its lower half, signed, and high
;;   is the upper half, signed, of the number plus 2^31.
(declare-const g (_ BitVec 64))
(define-fun low () (_ BitVec 64) ((_ sign_extend 32) ((_ extract 31 0) g)))
(define-fun high () (_ BitVec 64) ((_ sign_extend 32) ((_ extract 63 32) (bvadd g #x0000000080000000))))
(assert (not (= g (bvadd low (bvshl high (_ bv32 64))))))

;; weakened split_rounds: The same with the upper half of the number itself.
(declare-const g (_ BitVec 64))
(define-fun low () (_ BitVec 64) ((_ sign_extend 32) ((_ extract 31 0) g)))
(define-fun high () (_ BitVec 64) ((_ sign_extend 32) ((_ extract 63 32) g)))
(assert (not (= g (bvadd low (bvshl high (_ bv32 64))))))

;; claim product_64_32: g d is low d + 2^32 (high d) modulo 2^64: with g = low + 2^32 high + 2^64 k, the difference is
;;   2^64 k d.
(declare-const low Int) (declare-const high Int) (declare-const k Int) (declare-const d Int)
(define-fun g () Int (+ low (* two32 high) (* two64 k)))
(assert (not (= (- (* g d) (+ (* low d) (* two32 (* high d)))) (* two64 (* k d)))))

;; weakened product_64_32: The difference is 0.
(declare-const low Int) (declare-const high Int) (declare-const k Int) (declare-const d Int)
(define-fun g () Int (+ low (* two32 high) (* two64 k)))
(assert (not (= (- (* g d) (+ (* low d) (* two32 (* high d)))) 0)))
(assert (and (= low 0) (= high 0)))

;; claim product_64_64: With unsigned halves, g n is gl nl + 2^32 (gl nh + gh nl) modulo 2^64, where the sum in
;;   brackets may wrap, too: the difference is 2^64 gh nh.
(declare-const gl Int) (declare-const gh Int) (declare-const nl Int) (declare-const nh Int)
(assert (not (= (- (* (+ gl (* two32 gh)) (+ nl (* two32 nh))) (+ (* gl nl) (* two32 (+ (* gl nh) (* gh nl)))))
                (* two64 (* gh nh)))))

;; weakened product_64_64: The same with only one of the cross products.
(declare-const gl Int) (declare-const gh Int) (declare-const nl Int) (declare-const nh Int)
(assert (and (= gl 1) (= nl 1) (= gh 2) (= nh 3)))
(assert (not (= (mod (* (+ gl (* two32 gh)) (+ nl (* two32 nh))) two64)
                (mod (+ (* gl nl) (* two32 (* gh nl))) two64))))

;; claim flipped: (v xor f) - f is v where f is 0 and -v where f is -1, modulo 2^64.
(declare-const v (_ BitVec 64)) (declare-const f (_ BitVec 64))
(assert (or (= f (_ bv0 64)) (= f (bvnot (_ bv0 64)))))
(assert (not (= (bvsub (bvxor v f) f) (ite (= f (_ bv0 64)) v (bvneg v)))))

;; weakened flipped: It is -v where f is 1 as well.
(declare-const v (_ BitVec 64)) (declare-const f (_ BitVec 64))
(assert (or (= f (_ bv0 64)) (= f (_ bv1 64))))
(assert (not (= (bvsub (bvxor v f) f) (ite (= f (_ bv0 64)) v (bvneg v)))))

;; claim logical_shift: The lower halves of a logical and an arithmetic shift right by up to 15 are equal, so edge
;;   values may be shifted as unsigned numbers.
(declare-const v (_ BitVec 64)) (declare-const n (_ BitVec 64))
(assert (bvule n (_ bv15 64)))
(assert (not (= ((_ extract 31 0) (bvlshr v n)) ((_ extract 31 0) (bvashr v n)))))

;; weakened logical_shift: They are equal for a shift by 33.
(declare-const v (_ BitVec 64))
(assert (not (= ((_ extract 31 0) (bvlshr v (_ bv33 64))) ((_ extract 31 0) (bvashr v (_ bv33 64))))))

;; claim edge_products: In the set-up for a tile, every factor fits 32 bits and every sum stays below 2^62: the first
;;   edge value, its growth to the last pixel of a box in the tile, and the sum of both.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const sx Real) (declare-const sy Real) (declare-const last_x Real) (declare-const last_y Real)
(assert (and (in_guard px) (in_guard py) (in_guard qx) (in_guard qy) (in_guard sx) (in_guard sy)))
(assert (and (between 0.0 last_x 63.0) (between 0.0 last_y 63.0)))
(define-fun a () Real (edge_a py qy))
(define-fun b () Real (edge_b px qx))
(define-fun growth () Real (+ (* (maxr a 0.0) last_x) (* (maxr b 0.0) last_y)))
(define-fun fits ((v Real)) Bool (between (- 4611686018427387904.0) v 4611686018427387904.0))
(assert (not (and (int32r a) (int32r b) (int32r (- sx px)) (int32r (- sy py))
                  (fits (+ (edge_at px py qx qy sx sy) (* 32768.0 growth))))))

;; weakened edge_products: Every sum stays below 2^60.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const sx Real) (declare-const sy Real) (declare-const last_x Real) (declare-const last_y Real)
(assert (and (in_guard px) (in_guard py) (in_guard qx) (in_guard qy) (in_guard sx) (in_guard sy)))
(assert (and (between 0.0 last_x 63.0) (between 0.0 last_y 63.0)))
(define-fun a () Real (edge_a py qy))
(define-fun b () Real (edge_b px qx))
(define-fun growth () Real (+ (* (maxr a 0.0) last_x) (* (maxr b 0.0) last_y)))
(assert (and (= px (- 536870912.0)) (= py 536870912.0) (= qy (- 536870912.0)) (= sx 536870912.0)))
(assert (not (between (- (to_real two60)) (+ (edge_at px py qx qy sx sy) (* 32768.0 growth)) (to_real two60))))

;; claim area_in_pixels: Twice the area of a triangle, in whole square pixels, fits 32 bits.
(declare-const area Int)
(assert (and (<= 0 area) (<= area two60)))
(assert (not (int32 (div area two30))))

;; weakened area_in_pixels: In quarters of a square pixel it fits 32 bits.
(declare-const area Int)
(assert (and (<= 0 area) (<= area two60)))
(assert (not (int32 (div (* 4 area) two30))))

;; claim small_edges_fit: In mask_coverage-inl.h, where vertices are less than 2^4 px apart, a shifted edge value at the
;;   first sample of the box fits 32 bits, and stays there over 8 px on both axes.
(declare-const a Real) (declare-const b Real) (declare-const to_x Real) (declare-const to_y Real)
(declare-const x Real) (declare-const y Real) (declare-const value Real)
(define-fun small ((v Real)) Bool (< (absr v) 524288.0))
(assert (and (small a) (small b) (small to_x) (small to_y) (between 0.0 x 8.0) (between 0.0 y 8.0)))
(assert (between (- (/ (+ (* a to_x) (* b to_y)) 32768.0) 2.0) value (/ (+ (* a to_x) (* b to_y)) 32768.0)))
(assert (not (and (between (- 33554432.0) value 33554432.0) (int32r (+ value (* a x) (* b y))))))

;; weakened small_edges_fit: The value fits 24 bits.
(declare-const a Real) (declare-const b Real) (declare-const to_x Real) (declare-const to_y Real)
(declare-const value Real)
(define-fun small ((v Real)) Bool (< (absr v) 524288.0))
(assert (and (small a) (small b) (small to_x) (small to_y) (= a b to_x to_y)))
(assert (= value (/ (+ (* a to_x) (* b to_y)) 32768.0)))
(assert (not (between (- 8388608.0) value 8388607.0)))

;; claim no_area_no_sample: No sample belongs to all three edges of a triangle without area. So small triangles need no
;;   test of their area.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const rx Real) (declare-const ry Real) (declare-const sx Real) (declare-const sy Real)
(assert (= (signed_area px py qx qy rx ry) 0.0))
(assert (owns px py qx qy sx sy))
(assert (owns qx qy rx ry sx sy))
(assert (not (not (owns rx ry px py sx sy))))

;; weakened no_area_no_sample: No sample belongs to two of its edges.
(declare-const px Real) (declare-const py Real) (declare-const qx Real) (declare-const qy Real)
(declare-const rx Real) (declare-const ry Real) (declare-const sx Real) (declare-const sy Real)
(assert (= (signed_area px py qx qy rx ry) 0.0))
(assert (owns px py qx qy sx sy))
(assert (owns qx qy rx ry sx sy))
