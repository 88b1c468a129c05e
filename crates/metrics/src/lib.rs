//! One table of image metrics: id, formula, epsilon, averaging order, direction, non-finite policy
