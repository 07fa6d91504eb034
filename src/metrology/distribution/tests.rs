//! Quantiles against references of 17 digits and against what defines them.
//!
//! References: bisection of the incomplete beta and gamma functions of mpmath 1.x at 40 digits.

use super::*;
use proptest::prelude::*;

/// (p, degrees of freedom, t).
#[rustfmt::skip]
const STUDENT_T: &[(f64, f64, f64)] = &[
    (0.975, 0.01, 6.3641819284000115e+128),
    (0.975, 0.3, 6582.0356994007575),
    (0.975, 1.0, 12.706204736174693),
    (0.975, 2.5, 3.5746548420036818),
    (0.975, 15.0, 2.1314495455597752),
    (0.975, 100.0, 1.9839715185235519),
    (0.975, 999.0, 1.9623414611334496),
    (0.975, 1000.0, 1.9623390808264081),
    (0.975, 5000.0, 1.9604385517065075),
    (0.6, 0.01, 246458794.80554222),
    (0.6, 0.3, 0.50230128205930502),
    (0.6, 1.0, 0.32491969623290625),
    (0.6, 2.5, 0.28145951274854759),
    (0.6, 15.0, 0.25788530093726107),
    (0.6, 100.0, 0.25402218245822776),
    (0.6, 999.0, 0.25341458333036731),
    (0.6, 1000.0, 0.25341451583949871),
    (0.6, 5000.0, 0.25336058396923164),
    (0.500001, 0.01, 2.0138288973028164e-5),
    (0.500001, 0.3, 4.3607328543629242e-6),
    (0.500001, 1.0, 3.1415926536904672e-6),
    (0.500001, 2.5, 2.7638913426223067e-6),
    (0.500001, 15.0, 2.5487241973311353e-6),
    (0.500001, 100.0, 2.5129025804459115e-6),
    (0.500001, 999.0, 2.5072556374495366e-6),
    (0.500001, 1000.0, 2.5072550100085784e-6),
    (0.500001, 5000.0, 2.5067536092519433e-6),
    (0.9999, 0.3, 647878542583.32362),
    (0.9999, 1.0, 3183.0987571185015),
    (0.9999, 2.5, 34.867969321116311),
    (0.9999, 15.0, 4.8799982884245032),
    (0.9999, 100.0, 3.8615997909500908),
    (0.9999, 999.0, 3.7328654996083125),
    (0.9999, 1000.0, 3.7328516045753962),
    (0.9999, 5000.0, 3.7217761683368058),
    (1e-12, 0.3, -3.0071858087909792e+38),
    (1e-12, 1.0, -318309886183.79068),
    (1e-12, 2.5, -55306.174076515816),
    (1e-12, 15.0, -20.638607310216085),
    (1e-12, 100.0, -8.0258255944932531),
    (1e-12, 999.0, -7.1243197327606537),
    (1e-12, 1000.0, -7.1242289253144091),
    (1e-12, 5000.0, -7.0522785315297236),
    (0.999999999999, 0.3, 3.0074075664958731e+38),
    (0.999999999999, 1.0, 318316927901.77965),
    (0.999999999999, 2.5, 55306.663471176084),
    (0.999999999999, 15.0, 20.638638754969299),
    (0.999999999999, 100.0, 8.025830060218646),
    (0.999999999999, 999.0, 7.1243229349482188),
    (0.999999999999, 1000.0, 7.1242321273824426),
    (0.999999999999, 5000.0, 7.052281639409416),
];

/// (p, degrees of freedom, χ²).
#[rustfmt::skip]
const CHI_SQUARED: &[(f64, f64, f64)] = &[
    (0.05, 0.01, 7.0166677652357564e-261),
    (0.05, 0.3, 2.6719889953731294e-9),
    (0.05, 1.0, 0.0039321400000195232),
    (0.05, 2.5, 0.21075811235783619),
    (0.05, 15.0, 7.2609439276700303),
    (0.05, 100.0, 77.92946516501726),
    (0.05, 999.0, 926.63116092043288),
    (0.05, 9999.0, 9767.5367671061295),
    (0.05, 10000.0, 9768.5251356675368),
    (0.05, 20000.0, 19672.170221710383),
    (0.5, 0.01, 7.0166677652356113e-61),
    (0.5, 0.3, 0.012469611517980433),
    (0.5, 1.0, 0.45493642311957275),
    (0.5, 2.5, 1.8738477677808792),
    (0.5, 15.0, 14.338859510956647),
    (0.5, 100.0, 99.334129235988456),
    (0.5, 999.0, 998.33341248258799),
    (0.5, 9999.0, 9998.3333412359351),
    (0.5, 10000.0, 9999.3333412351448),
    (0.5, 20000.0, 19999.333337284095),
    (0.95, 0.01, 3.9523886527879123e-5),
    (0.95, 0.3, 1.6511748729089379),
    (0.95, 1.0, 3.8414588206941245),
    (0.95, 2.5, 6.9280761134524233),
    (0.95, 15.0, 24.995790139728627),
    (0.95, 100.0, 124.34211340400407),
    (0.95, 999.0, 1073.6426506574246),
    (0.95, 9999.0, 10232.737266236884),
    (0.95, 10000.0, 10233.748897677936),
    (0.95, 20000.0, 20330.103823932253),
    (1e-12, 0.3, 1.2599925262770267e-80),
    (1e-12, 1.0, 1.5707963267948966e-24),
    (1e-12, 2.5, 5.5515578929130788e-10),
    (1e-12, 15.0, 0.18139302834871602),
    (1e-12, 100.0, 30.084167586161841),
    (1e-12, 999.0, 716.10640291516657),
    (1e-12, 9999.0, 9036.3075027888969),
    (1e-12, 10000.0, 9037.2577723583874),
    (1e-12, 20000.0, 18625.257939708453),
    (0.9999999, 0.01, 17.166333384487482),
    (0.9999999, 0.3, 24.214330439431599),
    (0.9999999, 1.0, 28.373987362798125),
    (0.9999999, 2.5, 33.875640275656958),
    (0.9999999, 15.0, 62.325910569574702),
    (0.9999999, 100.0, 191.59647920386521),
    (0.9999999, 999.0, 1249.0080974788748),
    (0.9999999, 9999.0, 10751.696694806425),
    (0.9999999, 10000.0, 10752.733456617505),
    (0.9999999, 20000.0, 21057.280209446824),
];

fn assert_close(found: Option<f64>, expected: f64, relative: f64, what: &str) {
    let found = found.unwrap();
    assert!(
        (found - expected).abs() <= relative * expected.abs(),
        "{what}: {found:e}, expected {expected:e}, off by {:e}",
        found / expected - 1.0
    );
}

#[test]
fn quantiles_agree_with_printed_tables() {
    assert_close(student_t_quantile(0.975, 15.0), 2.13145, 3e-6, "t");
    assert_close(student_t_quantile(0.975, 1.0), 12.7062, 1e-6, "t");
    assert_close(student_t_quantile(0.975, f64::INFINITY), 1.959964, 1e-6, "t");
    assert_close(chi_squared_quantile(0.05, 15.0), 7.26094, 1e-6, "chi");
}

#[test]
fn student_t_agrees_with_the_references() {
    for &(p, dof, t) in STUDENT_T {
        assert_close(student_t_quantile(p, dof), t, 1e-10, &format!("t({p}, {dof})"));
    }
}

#[test]
fn chi_squared_agrees_with_the_references() {
    for &(p, dof, c) in CHI_SQUARED {
        assert_close(chi_squared_quantile(p, dof), c, 1e-10, &format!("chi({p}, {dof})"));
    }
}

#[test]
fn the_expansions_join_the_incomplete_functions() {
    for p in [1e-6, 0.05, 0.3, 0.7, 0.95, 0.999_999] {
        let below = |limit: f64| limit * (1.0 - 1e-13);
        let limit = MANY_DEGREES_STUDENT;
        let joined = student_t_quantile(p, limit).unwrap();
        assert_close(student_t_quantile(p, below(limit)), joined, 1e-11, "t");
        let limit = MANY_DEGREES_CHI_SQUARED;
        let joined = chi_squared_quantile(p, limit).unwrap();
        assert_close(chi_squared_quantile(p, below(limit)), joined, 1e-10, "chi");
    }
}

#[test]
fn quantiles_beyond_the_range_of_a_double_are_its_ends() {
    assert_eq!(student_t_quantile(0.975, 1e-5), Some(f64::INFINITY));
    assert_eq!(student_t_quantile(0.025, 1e-5), Some(f64::NEG_INFINITY));
    assert_eq!(chi_squared_quantile(0.05, 1e-5), Some(0.0));
}

#[test]
fn outside_the_domain_there_is_no_quantile() {
    for p in [0.0, 1.0, -0.1, 1.1, f64::NAN, f64::INFINITY] {
        assert_eq!(normal_quantile(p), None);
        assert_eq!(student_t_quantile(p, 15.0), None);
        assert_eq!(chi_squared_quantile(p, 15.0), None);
    }
    for dof in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(student_t_quantile(0.9, dof), None);
        assert_eq!(chi_squared_quantile(0.9, dof), None);
    }
    assert_eq!(chi_squared_quantile(0.9, f64::INFINITY), None);
}

proptest! {
    #[test]
    fn student_t_with_one_and_two_degrees_has_its_closed_form(p in 0.001..0.999f64) {
        // ν = 1: t = tan(π (p − 1/2));  ν = 2: t = (2p − 1) / √(2 p (1 − p)).
        let q = p - 0.5;
        let one = student_t_quantile(p, 1.0).unwrap();
        prop_assert!((one - (std::f64::consts::PI * q).tan()).abs() <= 1e-11 * one.abs());
        let two = student_t_quantile(p, 2.0).unwrap();
        prop_assert!((two - 2.0 * q / (2.0 * p * (1.0 - p)).sqrt()).abs() <= 1e-11 * two.abs());
    }

    #[test]
    fn chi_squared_with_two_degrees_is_exponential(p in 1e-9..0.999f64) {
        let c = chi_squared_quantile(p, 2.0).unwrap();
        prop_assert!((c + 2.0 * (-p).ln_1p()).abs() <= 1e-11 * c);
    }

    #[test]
    fn student_t_is_antisymmetric(tail in 1u64..(1 << 52), dof in 0.01..1e7f64) {
        // Multiples of 2^-53, so that 1 - p is exact.
        let p = tail as f64 / (1u64 << 53) as f64;
        prop_assert_eq!(student_t_quantile(p, dof), student_t_quantile(1.0 - p, dof).map(|t| -t));
    }

    #[test]
    fn quantiles_rise_with_the_probability(p in 1e-12..0.999f64, ln_dof in -4.0..16.0f64) {
        let (dof, more) = (ln_dof.exp(), p + 1e-6 * p.min(1.0 - p));
        prop_assert!(normal_quantile(more) > normal_quantile(p));
        prop_assert!(student_t_quantile(more, dof) > student_t_quantile(p, dof));
        let (low, high) = (chi_squared_quantile(p, dof).unwrap(), chi_squared_quantile(more, dof).unwrap());
        prop_assert!(high > low || low == 0.0);
    }

    #[test]
    fn every_input_has_an_answer_that_is_a_number(p in any::<u64>(), dof in any::<u64>(), q in 0.0..1.0f64, nu in 1e-300..1e300f64) {
        for (p, dof) in [(f64::from_bits(p), f64::from_bits(dof)), (q, f64::from_bits(dof)), (q, nu)] {
            for x in [normal_quantile(p), student_t_quantile(p, dof), chi_squared_quantile(p, dof)].into_iter().flatten() {
                prop_assert!(!x.is_nan(), "{p:e} {dof:e}");
            }
        }
    }
}

/// (z, Φ(z)) by the C library's erfc, which is exact to the last digit; ours is that of `statrs`, good to the 1e-10 that the module states.
const NORMAL: &[(f64, f64)] = &[
    (-8.0, 6.220960574271819e-16),
    (-3.0, 0.0013498980316300957),
    (-1.0, 0.15865525393145707),
    (0.0, 0.5),
    (0.5, 0.6914624612740131),
    (2.0, 0.9772498680518208),
    (6.0, 0.9999999990134123),
];

#[test]
fn the_normal_cumulative_agrees_with_references_and_integrates_its_density() {
    for &(z, expected) in NORMAL {
        assert!((normal_cumulative(z) / expected - 1.0).abs() < 1e-10, "{z}: {}", normal_cumulative(z));
        let h = 1e-3;
        let slope = (normal_cumulative(z + h) - normal_cumulative(z - h)) / (2.0 * h);
        // Third derivative of Φ over density is z² − 1; rounding of values near 1.
        let allowed = 1e-6 * (1.0 + z * z) * normal_density(z) + 1e-12;
        assert!((slope - normal_density(z)).abs() < allowed, "{z}: {slope}");
    }
    let quantile = normal_quantile(0.1).unwrap();
    assert!((normal_cumulative(quantile) / 0.1 - 1.0).abs() < 1e-10);
}

#[test]
fn normal_probabilities_and_quantiles_undo_each_other() {
    for p in [1e-12, 1e-3, 0.2, 0.5, 0.8, 0.999] {
        let z = normal_quantile(p).unwrap();
        assert!((normal_cumulative(z) / p - 1.0).abs() < 1e-9, "{p}");
    }
    assert_eq!((normal_cumulative(f64::INFINITY), normal_cumulative(f64::NEG_INFINITY)), (1.0, 0.0));
    assert!(normal_cumulative(f64::NAN).is_nan());
}
