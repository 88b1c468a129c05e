//! Study files to plan to cells to records to analysis, resumable at every stage
