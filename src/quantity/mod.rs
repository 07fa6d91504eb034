//! Units: the two-way table of quantity and system as types.
