//! The arithmetic on eight lanes with AVX2 instructions: operation by operation what [`super::traverse::Portable`] does, with the
//! same roundings, hence the same bits. The only file with `unsafe`.
//!
//! Safety. There are two kinds of unsafe operation here. (1) A call of a function that is compiled for AVX2: a value of [`Avx2`] is the
//! permission; it is only made by [`Avx2::detect`] after the processor was asked, and its field is private. (2) Loads and stores through
//! pointers: each pointer comes from a reference to `[f32; 8]` or `[u32; 8]`, exactly the 32 bytes that are moved, and the unaligned forms are used.

#![allow(unsafe_code)]

#[cfg(target_arch = "x86_64")]
pub(super) use x86_64::Avx2;

#[cfg(not(target_arch = "x86_64"))]
pub(super) use other::Avx2;

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use super::super::node::{LEAF, Node, Packet};
    use super::super::traverse::{self, Crossing, Kernel, Prepared};
    use super::super::{Bvh, Hit};
    use std::arch::x86_64::*;

    /// Proof that the processor has AVX2.
    #[derive(Clone, Copy, Debug)]
    pub(in super::super) struct Avx2(());

    impl Avx2 {
        /// Asks the processor.
        pub(in super::super) fn detect() -> Option<Avx2> {
            (is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi1")).then_some(Avx2(()))
        }

        /// See [`Bvh::closest`].
        #[inline]
        pub(in super::super) fn closest(self, bvh: &Bvh, ray: &Prepared) -> Option<Hit> {
            // SAFETY: (1), self is the permission.
            unsafe { closest(self, bvh, ray) }
        }

        /// See [`Bvh::blocked`].
        #[inline]
        pub(in super::super) fn blocked(self, bvh: &Bvh, ray: &Prepared) -> bool {
            // SAFETY: (1), self is the permission.
            unsafe { blocked(self, bvh, ray) }
        }
    }

    #[target_feature(enable = "avx2,bmi1")]
    fn closest(kernel: Avx2, bvh: &Bvh, ray: &Prepared) -> Option<Hit> {
        traverse::closest(kernel, bvh, ray)
    }

    #[target_feature(enable = "avx2,bmi1")]
    fn blocked(kernel: Avx2, bvh: &Bvh, ray: &Prepared) -> bool {
        traverse::blocked(kernel, bvh, ray)
    }

    impl Kernel for Avx2 {
        #[inline(always)]
        fn boxes(self, node: &Node, ray: &Prepared, t_best: f32, entry: &mut [f32; 8]) -> u32 {
            // SAFETY: (1), self is the permission.
            unsafe { boxes(node, ray, t_best, entry) }
        }

        #[inline(always)]
        fn triangles(self, packet: &Packet, ray: &Prepared, t_best: f32, crossing: &mut Crossing) -> u32 {
            // SAFETY: (1), self is the permission.
            unsafe { triangles(packet, ray, t_best, crossing) }
        }

        #[inline(always)]
        fn prefetch(self, bvh: &Bvh, child: u32) {
            if child & LEAF == 0 {
                touch::<4>(bvh.nodes.as_ptr().wrapping_add(child as usize).cast());
            } else {
                touch::<5>(bvh.packets.as_ptr().wrapping_add((child & !LEAF) as usize).cast());
            }
        }
    }

    #[inline(always)]
    fn touch<const LINES: usize>(start: *const i8) {
        for line in 0..LINES {
            // SAFETY: a prefetch reads nothing and may be given any address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(64 * line)) };
        }
    }

    #[inline]
    #[target_feature(enable = "avx2,bmi1")]
    fn load(row: &[f32; 8]) -> __m256 {
        // SAFETY: (2).
        unsafe { _mm256_loadu_ps(row.as_ptr()) }
    }

    #[inline]
    #[target_feature(enable = "avx2,bmi1")]
    fn store(row: &mut [f32; 8], lanes: __m256) {
        // SAFETY: (2).
        unsafe { _mm256_storeu_ps(row.as_mut_ptr(), lanes) }
    }

    #[inline]
    #[target_feature(enable = "avx2,bmi1")]
    fn slab(row: &[f32; 8], origin: f32, scale: f32) -> __m256 {
        _mm256_mul_ps(_mm256_sub_ps(load(row), _mm256_set1_ps(origin)), _mm256_set1_ps(scale))
    }

    #[inline]
    #[target_feature(enable = "avx2,bmi1")]
    fn boxes(node: &Node, ray: &Prepared, t_best: f32, entry: &mut [f32; 8]) -> u32 {
        let mut near = _mm256_set1_ps(ray.t_min);
        let mut far = _mm256_set1_ps(t_best);
        for i in [2, 1, 0] {
            near = _mm256_max_ps(slab(&node.bounds[ray.near[i]], ray.origin[i], ray.near_scale[i]), near);
            far = _mm256_min_ps(slab(&node.bounds[ray.far[i]], ray.origin[i], ray.far_scale[i]), far);
        }
        store(entry, near);
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(near, far)) as u32
    }

    #[inline]
    #[target_feature(enable = "avx2,bmi1")]
    fn triangles(packet: &Packet, ray: &Prepared, t_best: f32, crossing: &mut Crossing) -> u32 {
        let [kx, ky, kz] = ray.axis;
        let [sx, sy, sz] = ray.shear.map(|s| _mm256_set1_ps(s));
        let origin = [kx, ky, kz].map(|k| _mm256_set1_ps(ray.origin[k]));
        let shear = |rows: &[[f32; 8]; 3]| {
            let z = _mm256_sub_ps(load(&rows[kz]), origin[2]);
            let x = _mm256_sub_ps(_mm256_sub_ps(load(&rows[kx]), origin[0]), _mm256_mul_ps(sx, z));
            let y = _mm256_sub_ps(_mm256_sub_ps(load(&rows[ky]), origin[1]), _mm256_mul_ps(sy, z));
            [x, y, z]
        };
        let [ax, ay, az] = shear(&packet.vertex[0]);
        let [bx, by, bz] = shear(&packet.vertex[1]);
        let [cx, cy, cz] = shear(&packet.vertex[2]);
        let u = _mm256_sub_ps(_mm256_mul_ps(cx, by), _mm256_mul_ps(cy, bx));
        let v = _mm256_sub_ps(_mm256_mul_ps(ax, cy), _mm256_mul_ps(ay, cx));
        let w = _mm256_sub_ps(_mm256_mul_ps(bx, ay), _mm256_mul_ps(by, ax));
        let zero = _mm256_setzero_ps();
        let all = |p: __m256, q: __m256, r: __m256| _mm256_and_ps(_mm256_and_ps(p, q), r);
        let front = all(_mm256_cmp_ps::<_CMP_GE_OQ>(u, zero), _mm256_cmp_ps::<_CMP_GE_OQ>(v, zero), _mm256_cmp_ps::<_CMP_GE_OQ>(w, zero));
        let back = all(_mm256_cmp_ps::<_CMP_LE_OQ>(u, zero), _mm256_cmp_ps::<_CMP_LE_OQ>(v, zero), _mm256_cmp_ps::<_CMP_LE_OQ>(w, zero));
        let inside = _mm256_or_ps(front, back);
        if _mm256_movemask_ps(inside) == 0 {
            return 0;
        }
        let determinant = _mm256_add_ps(_mm256_add_ps(u, v), w);
        let height = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(u, az), _mm256_mul_ps(v, bz)), _mm256_mul_ps(w, cz));
        let t = _mm256_div_ps(_mm256_mul_ps(sz, height), determinant);
        let after = _mm256_cmp_ps::<_CMP_GT_OQ>(t, _mm256_set1_ps(ray.t_min));
        let before = _mm256_cmp_ps::<_CMP_LT_OQ>(t, _mm256_set1_ps(t_best));
        // SAFETY: (2).
        let triangle = unsafe { _mm256_loadu_si256(packet.triangle.as_ptr().cast()) };
        let skipped = _mm256_or_si256(
            _mm256_cmpeq_epi32(triangle, _mm256_set1_epi32(ray.skip[0] as i32)),
            _mm256_cmpeq_epi32(triangle, _mm256_set1_epi32(ray.skip[1] as i32)),
        );
        let hit = _mm256_andnot_ps(_mm256_castsi256_ps(skipped), all(inside, after, before));
        let lanes = _mm256_movemask_ps(hit) as u32;
        if lanes != 0 {
            store(&mut crossing.t, t);
            store(&mut crossing.edge[0], u);
            store(&mut crossing.edge[1], v);
            store(&mut crossing.edge[2], w);
        }
        lanes
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod other {
    use super::super::traverse::Prepared;
    use super::super::{Bvh, Hit};

    /// Has no value on this processor.
    #[derive(Clone, Copy, Debug)]
    pub(in super::super) enum Avx2 {}

    impl Avx2 {
        /// There is no AVX2 here.
        pub(in super::super) fn detect() -> Option<Avx2> {
            None
        }

        pub(in super::super) fn closest(self, _: &Bvh, _: &Prepared) -> Option<Hit> {
            match self {}
        }

        pub(in super::super) fn blocked(self, _: &Bvh, _: &Prepared) -> bool {
            match self {}
        }
    }
}
