//! Why points and triangles do not make a mesh.

/// What is wrong with the points or triangles of a mesh. Indices count from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// There is no triangle.
    #[error("the mesh has no triangles")]
    NoTriangles,
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    VertexNotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {index}, but there are only {vertices} vertices")]
    IndexOutOfRange {
        /// Index of the triangle.
        triangle: usize,
        /// The index that it names.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// The mesh is so small or so large that its areas leave the range of double precision.
    #[error("the largest extent of the mesh is {extent_m:e} m; it must be between 1e-140 m and 1e140 m")]
    ExtentOutOfRange {
        /// Largest edge of the bounding box in metres.
        extent_m: f64,
    },
    /// No triangle has an area.
    #[error("all {triangles} triangles have zero area")]
    AllDegenerate {
        /// Number of triangles.
        triangles: usize,
    },
    /// More triangles than an index of 31 bits can name.
    #[error("{triangles} triangles are more than 2^31 - 1")]
    TooManyTriangles {
        /// Number of triangles.
        triangles: usize,
    },
}
