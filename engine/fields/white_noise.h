#pragma once

#include <optional>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"

/// How smooth a diffusion is, by what it makes of white noise.
namespace seamflow {

/// Independent numbers of variance 1, the same on every machine: #V by 3.
Eigen::MatrixXd white_noise(Index n_vertices);

/// The full width at half maximum, in length, of the Gaussian kernel that makes white noise as smooth as this: from the
/// variance of the values and that of their differences along edges (Forman and others 1995; Hagler, Saygin and Sereno,
/// Smoothing and Cluster Thresholding for Cortical Surface-Based Group Analysis, 2006). The mean over the columns.
/// @param noise #V by any number of columns; vertices without faces do not count.
/// @returns nothing where that says nothing: without edges, or where values do not differ.
std::optional<double> fwhm_of_noise(const PolygonMesh& mesh, const Eigen::MatrixXd& noise);

}  // namespace seamflow
