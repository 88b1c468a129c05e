//! The border rule of patches.

use noisefloor_kernels::mirror;

#[test]
fn mirroring_reflects_as_often_as_needed() {
    let at = |n| (-7..=8).map(|i| mirror(i, n)).collect::<Vec<_>>();
    assert_eq!(at(1), [0; 16]);
    assert_eq!(at(2), [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0]);
    assert_eq!(at(4), [1, 0, 1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1, 2]);
}
