//! Fast shared filter kernels, each beside a slow obvious twin
