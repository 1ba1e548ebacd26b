//! Exact series for the homogeneous sphere: Lorenz–Mie and its Debye expansion.
