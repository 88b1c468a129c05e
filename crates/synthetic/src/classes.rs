/// A class for every pixel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Classes {
    /// Names, indexed by the entries of `of_pixel`.
    pub names: Vec<String>,
    /// Row-major: index into `names`.
    pub of_pixel: Vec<u8>,
}
