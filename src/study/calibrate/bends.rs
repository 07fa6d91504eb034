//! What a curve bends between its nodes, as a part of its uncertainty; and whether it is so much that it has to be said.
//!
//! ```text
//! |s − chord| ≤ h² |s″| / 8        mean over an interval: h² |s″| / 12        h² s″ ≈ s(k−1) − 2 s(k) + s(k+1)
//! u_k² = u_fit² + (h² s″ / 12)²
//! ```
//!
//! A fitted curve is linear between its nodes, and so are the weights of the exposures. Where the true curve bends, the fit gives the chords the
//! right integrals: its nodes lie off the true curve by the mean distance of a chord. With little noise that is the largest error. What the curve is used for are
//! integrals, in which it cancels; it is no part of their uncertainty.

/// Share of the nodes at which a curve may bend more than else is uncertain before it is said.
const COARSE: f64 = 0.05;

/// Standard uncertainties of a fitted curve at its nodes, with what it bends between them; in the unit of the curve.
pub(in crate::study) fn with_bends(values: &[f64], fitted: &[f64]) -> Vec<f64> {
    let last = values.len().saturating_sub(2);
    let bend = |k: usize| match values.get(k.clamp(1, last.max(1)) - 1..) {
        Some([a, b, c, ..]) => (a - 2.0 * b + c) / 12.0,
        // Two nodes are a straight line.
        _ => 0.0,
    };
    fitted.iter().enumerate().map(|(k, u)| u.hypot(bend(k))).collect()
}

/// What is to be said of a curve with a name and a unit, from its values and their standard uncertainties without what it bends.
pub(in crate::study) fn too_coarse(
    nodes_nm: &[f64],
    values: &[f64],
    standard_uncertainties: &[f64],
    (name, unit): (&str, &str),
) -> Option<String> {
    let bends: Vec<f64> = values.windows(3).map(|w| 0.125 * (w[0] - 2.0 * w[1] + w[2]).abs()).collect();
    let beyond = bends.iter().zip(standard_uncertainties.iter().skip(1)).filter(|(bend, u)| bend > u).count();
    let largest = bends.iter().fold(0.0f64, |most, bend| most.max(*bend));
    (beyond as f64 > COARSE * nodes_nm.len() as f64).then(|| {
        format!(
            "{name}: between nodes that are {} nm apart the curve bends by up to {largest:.2e} {unit}, at {beyond} nodes more than all else that is uncertain \
             there; give `curve` a smaller `step_nm`",
            nodes_nm[1] - nodes_nm[0]
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_bends_nowhere_and_a_parabola_everywhere_alike() {
        assert_eq!(with_bends(&[1.0, 2.0, 3.0, 4.0], &[0.5; 4]), [0.5; 4]);
        assert_eq!(with_bends(&[1.0, 2.0], &[0.5; 2]), [0.5; 2]);
        for u in with_bends(&[0.0, 1.0, 4.0, 9.0], &[0.0; 4]) {
            assert!((u - 2.0 / 12.0).abs() < 1e-15, "{u}");
        }
    }

    #[test]
    fn a_parabola_bends_by_an_eighth_of_its_second_difference() {
        let nodes: Vec<f64> = (0..21).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
        // The chord from 490 nm to 500 nm lies 25 c above the parabola's middle: c (95² − (90² + 100²)/2) = −25 c.
        let values: Vec<f64> = nodes.iter().map(|nm| 1e-4 * (nm - 400.0).powi(2)).collect();
        assert_eq!(too_coarse(&nodes, &values, &[2.6e-3; 21], ("E", "lx")), None);
        let said = too_coarse(&nodes, &values, &[2.4e-3; 21], ("E", "lx")).expect("a remark");
        assert!(said.contains("2.50e-3 lx") && said.contains("at 19 nodes"), "{said}");
    }
}
