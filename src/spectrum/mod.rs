//! Functions of wavelength: densities, factors, lines, exact product integrals.
