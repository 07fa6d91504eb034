//! Whether a curve bends more between its nodes than its uncertainty holds.
//!
//! ```text
//! |s − chord| ≤ h² |s″| / 8 ≈ |s(k−1) − 2 s(k) + s(k+1)| / 8        h: distance of the nodes
//! ```
//!
//! A fitted curve is linear between its nodes, and so are the weights of the exposures. What the true curve bends there is in no band. With little
//! noise it is the largest error, and has to be said.

/// Share of the nodes at which a curve may bend more than its uncertainty before it is said.
const COARSE: f64 = 0.05;

/// What is to be said of a curve with a name and a unit, from its values and standard uncertainties at the nodes.
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
            "{name}: between nodes that are {} nm apart the curve bends by up to {largest:.2e} {unit}, at {beyond} nodes more than its uncertainty, which does \
             not hold that; give `curve` a smaller `step_nm`",
            nodes_nm[1] - nodes_nm[0]
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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
