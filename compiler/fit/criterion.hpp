// The effective number of samples in a recording, and a criterion to choose between models.
#pragma once

#include "fit/problem.hpp"

namespace dashpot::compiler::fitting {

// n_e = max(12, n/(1 + 2Σρ_k)), ρ_k the autocorrelation of a model's residuals, summed over Geyer's pairs
// ρ_2k + ρ_2k+1 > 0 (Geyer 1992, Statist. Sci. 7:473), pooled over the files; storage and loss are files of their own.
// Rows that follow each other much faster than anything happens carry little new information.
double effective_samples(const Problem& problem, const Model& model);

// The same from the residuals of one run of rows.
double effective_samples(const Eigen::VectorXd& left);

// Correlation of neighbouring residuals in one file.
double lag_one_correlation(const Eigen::VectorXd& left);

// Bayesian information criterion n_e ln(RSS/n) + p ln n_e, n the weighted rows: less is better.
double criterion(const Problem& problem, const Model& model, double effective, bool gains_are_free);

}  // namespace dashpot::compiler::fitting
