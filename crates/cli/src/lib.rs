//! The noisefloor command as a library, one verb per file
