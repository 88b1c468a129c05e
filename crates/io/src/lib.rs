//! OpenEXR files to frames and back, including other renderers' conventions
