//! Mean transmittance of a piece of a ray, for emission that is not weighted by extinction (Song et al. 2009, Eq. 4):
//! colour = c D `mean`, D the piece's length.
