//! One folder for each question that is put to the data.
