//! Synthetic frames with exactly known truth and a chosen sample law
