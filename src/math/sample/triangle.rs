//! Barycentric coordinates of a triangle, uniformly in its area (Turk's square-root map, continuous in its numbers).

/// Barycentric coordinates (b0, b1, b2), each ≥ 0, their sum 1.
#[inline(always)]
#[must_use]
pub fn sample_triangle(u: [f64; 2]) -> [f64; 3] {
    let root = u[0].sqrt();
    [1.0 - root, root * (1.0 - u[1]), root * u[1]]
}

/// Density over (b1, b2): 2. Per unit area of a triangle of area A it is 1/A.
#[must_use]
pub fn triangle_pdf() -> f64 {
    2.0
}

/// The numbers that [`sample_triangle`] maps to barycentric coordinates.
#[must_use]
pub fn invert_triangle(b: [f64; 3]) -> [f64; 2] {
    let root = b[1] + b[2];
    [root * root, if root == 0.0 { 0.5 } else { b[2] / root }]
}
