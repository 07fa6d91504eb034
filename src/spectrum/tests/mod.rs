//! Tests of this layer that are longer than their file would bear.

mod densities;
mod factors;
mod library;
mod products;
mod quadrature;
mod table_text;
