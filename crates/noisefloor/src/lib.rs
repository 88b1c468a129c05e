//! Evaluation workbench for Monte Carlo denoisers: the facade and the command
