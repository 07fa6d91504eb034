//! Memory layout of the tree: one node is eight boxes, one packet is up to eight triangles, both one array per coordinate.

/// The bit of a child's code that marks a leaf; the other bits are the index of its packet.
pub(super) const LEAF: u32 = 1 << 31;
/// The code of the root, which is always an inner node.
pub(super) const ROOT: u32 = 0;

/// Up to eight children with their boxes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Rows x min, y min, z min, x max, y max, z max; one lane a child. A lane without a child holds the empty box (+inf, -inf).
    pub(super) bounds: [[f32; 8]; 6],
    /// Index of a node, or [`LEAF`] with the index of a packet.
    pub(super) child: [u32; 8],
}

impl Node {
    /// A node without children.
    pub(super) const EMPTY: Node = Node {
        bounds: [
            [f32::INFINITY; 8],
            [f32::INFINITY; 8],
            [f32::INFINITY; 8],
            [f32::NEG_INFINITY; 8],
            [f32::NEG_INFINITY; 8],
            [f32::NEG_INFINITY; 8],
        ],
        child: [0; 8],
    };

    /// Puts a child into a lane.
    pub(super) fn set(&mut self, lane: usize, min: [f32; 3], max: [f32; 3], child: u32) {
        for axis in 0..3 {
            self.bounds[axis][lane] = min[axis];
            self.bounds[axis + 3][lane] = max[axis];
        }
        self.child[lane] = child;
    }

    /// The largest `normal . p` of the points of a child's box; minus infinity or NaN for an empty lane.
    pub(super) fn support(&self, lane: usize, normal: [f64; 3]) -> f64 {
        if self.bounds[0][lane] > self.bounds[3][lane] {
            return f64::NEG_INFINITY;
        }
        (0..3).map(|axis| normal[axis] * f64::from(self.bounds[if normal[axis] > 0.0 { axis + 3 } else { axis }][lane])).sum()
    }
}

/// Up to eight triangles.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Packet {
    /// Coordinates by vertex, axis, lane. A lane without a triangle holds NaN, which no comparison accepts.
    pub(super) vertex: [[[f32; 8]; 3]; 3],
    /// Index of each triangle; `u32::MAX` in a lane without one.
    pub(super) triangle: [u32; 8],
}

impl Packet {
    /// A packet without triangles.
    pub(super) const EMPTY: Packet = Packet { vertex: [[[f32::NAN; 8]; 3]; 3], triangle: [u32::MAX; 8] };

    /// Puts a triangle into a lane.
    pub(super) fn set(&mut self, lane: usize, corners: [[f32; 3]; 3], triangle: u32) {
        for (rows, corner) in self.vertex.iter_mut().zip(corners) {
            for (row, coordinate) in rows.iter_mut().zip(corner) {
                row[lane] = coordinate;
            }
        }
        self.triangle[lane] = triangle;
    }

    /// Whether a vertex of a triangle has `normal . v > offset`.
    pub(super) fn any_vertex_beyond(&self, normal: [f64; 3], offset: f64) -> bool {
        self.vertex
            .iter()
            .any(|rows| (0..8).any(|lane| (0..3).map(|axis| normal[axis] * f64::from(rows[axis][lane])).sum::<f64>() > offset))
    }
}
