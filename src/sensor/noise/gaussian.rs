//! A standard normal number from 64 random bits, by the inverse of its distribution.
//!
//! ```text
//! z = Φ⁻¹(u),   u = (top 52 bits + ½)/2⁵²
//! ```
//!
//! Rational approximations to 1e-15: M. J. Wichura, *Algorithm AS 241*, Applied Statistics 37 (1988) 477, PPND16. The largest |z| is 8.2.

const CENTRE: ([f64; 8], [f64; 8]) = (
    [
        3.387_132_872_796_366_608,
        133.141_667_891_784_377_45,
        1_971.590_950_306_551_442_7,
        13_731.693_765_509_461_125,
        45_921.953_931_549_871_457,
        67_265.770_927_008_700_853,
        33_430.575_583_588_128_105,
        2_509.080_928_730_122_672_7,
    ],
    [
        1.0,
        42.313_330_701_600_911_252,
        687.187_007_492_057_908_3,
        5_394.196_021_424_751_107_7,
        21_213.794_301_586_595_867,
        39_307.895_800_092_710_61,
        28_729.085_735_721_942_674,
        5_226.495_278_852_854_561,
    ],
);
const TAIL: ([f64; 8], [f64; 8]) = (
    [
        1.423_437_110_749_683_577_34,
        4.630_337_846_156_545_295_9,
        5.769_497_221_460_691_405_5,
        3.647_848_324_763_204_605_04,
        1.270_458_252_452_368_382_58,
        0.241_780_725_177_450_611_77,
        0.022_723_844_989_269_184_583_3,
        7.745_450_142_783_414_076_4e-4,
    ],
    [
        1.0,
        2.053_191_626_637_758_821_87,
        1.676_384_830_183_803_849_4,
        0.689_767_334_985_100_004_55,
        0.148_103_976_427_480_074_59,
        0.015_198_666_563_616_457_196_6,
        5.475_938_084_995_344_946e-4,
        1.050_750_071_644_416_843_24e-9,
    ],
);
const FAR_TAIL: ([f64; 8], [f64; 8]) = (
    [
        6.657_904_643_501_103_777_2,
        5.463_784_911_164_114_369_9,
        1.784_826_539_917_291_335_8,
        0.296_560_571_828_504_891_23,
        0.026_532_189_526_576_123_093,
        1.242_660_947_388_078_438_6e-3,
        2.711_555_568_743_487_578_15e-5,
        2.010_334_399_292_288_132_65e-7,
    ],
    [
        1.0,
        0.599_832_206_555_887_937_69,
        0.136_929_880_922_735_805_31,
        0.014_875_361_290_850_614_852_5,
        7.868_691_311_456_132_591e-4,
        1.846_318_317_510_054_681_8e-5,
        1.421_511_758_316_445_888_7e-7,
        2.044_263_103_389_939_785_64e-15,
    ],
);

#[inline(always)]
fn ratio(of: &([f64; 8], [f64; 8]), x: f64) -> f64 {
    let polynomial = |c: &[f64; 8]| c.iter().rev().fold(0.0, |sum, &a| sum * x + a);
    polynomial(&of.0) / polynomial(&of.1)
}

/// A standard normal number.
#[inline(always)]
pub(super) fn normal(bits: u64) -> f64 {
    // Distance from ½: an odd multiple of 2⁻⁵³, exact and neither 0 nor ±½. With one bit more the half would be rounded away.
    let q = ((bits >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64) - 0.5;
    if q.abs() <= 0.425 { q * ratio(&CENTRE, 0.180_625 - q * q) } else { tail(q) }
}

fn tail(q: f64) -> f64 {
    let r = (-(0.5 - q.abs()).ln()).sqrt();
    let z = if r <= 5.0 { ratio(&TAIL, r - 1.6) } else { ratio(&FAR_TAIL, r - 5.0) };
    z.copysign(q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrology::distribution::normal_quantile;

    #[test]
    fn it_is_the_quantile_of_the_normal_distribution() {
        for i in 0..4000u64 {
            // From one end to the other, dense at both.
            let bits = if i < 2000 { i.pow(5) << 8 } else { u64::MAX - ((3999 - i).pow(5) << 8) };
            let p = ((bits >> 12) as f64 + 0.5) / (1u64 << 52) as f64;
            let (found, expected) = (normal(bits), normal_quantile(p).unwrap());
            assert!((found - expected).abs() <= 1e-9, "{p}: {found} {expected}");
        }
        assert!(normal(0) < -8.2 && normal(0) > -8.3 && normal(u64::MAX) == -normal(0));
    }
}
