//! Plots in SVG and PNG.
