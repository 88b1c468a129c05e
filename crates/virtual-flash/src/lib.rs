//! Moon et al. 2013: virtual flash image with homogeneous pixels
