//! Why frames give no figures.

/// Why there are no figures, or no frame.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EmvaError {
    /// A series that cannot be measured.
    #[error("{0}")]
    Series(String),
    /// The frames do not show what a figure needs.
    #[error("{0}")]
    Frames(String),
    /// Whoever takes the frames has failed.
    #[error("{0}")]
    Camera(String),
}
