#pragma once

#include <optional>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"

/// The width of a diffusion, measured by its effect on white noise.
namespace seamflow {

/// #V by n: independent numbers of variance 1, the same on every machine.
Eigen::MatrixXd white_noise(Index n_vertices, Eigen::Index n_columns = 3);

/// The full width at half maximum, in length, of the Gaussian kernel that makes white noise as smooth as `noise`: from
/// the variance of the values and the variance of their differences along edges (Forman and others 1995; Hagler, Saygin
/// and Sereno, Smoothing and Cluster Thresholding for Cortical Surface-Based Group Analysis, 2006). The mean over the
/// columns.
/// @param noise #V by any number of columns; vertices without faces do not count.
/// @returns nothing unless, in each column, the correlation of values along edges is above 0 and below 1: so without
/// edges, if values do not differ, or if neighbours are as independent as in white noise.
std::optional<double> fwhm_of_noise(const PolygonMesh& mesh, const Eigen::MatrixXd& noise);

}  // namespace seamflow
