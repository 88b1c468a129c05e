//! Records and summaries to plots, tables and one self-contained HTML page
