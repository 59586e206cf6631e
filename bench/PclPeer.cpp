#include "PclPeer.h"

#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/ia_ransac.h>
#include <pcl/search/kdtree.h>

#include <algorithm>

namespace lamp {

namespace {

using Point = pcl::PointXYZ;
using Points = pcl::PointCloud<Point>;
using Feature = pcl::FPFHSignature33;
using FeatureCloud = pcl::PointCloud<Feature>;

Points::Ptr toPcl(const Cloud& cloud) {
  auto points = std::make_shared<Points>();
  for (const Eigen::Vector3f& p : cloud.points) points->push_back({p.x(), p.y(), p.z()});
  return points;
}

pcl::PointCloud<pcl::Normal>::Ptr normalsOf(const Points::Ptr& points,
                                            const Eigen::Vector3f& viewpoint) {
  auto normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  pcl::NormalEstimation<Point, pcl::Normal> estimation;
  estimation.setInputCloud(points);
  estimation.setSearchMethod(std::make_shared<pcl::search::KdTree<Point>>());
  estimation.setKSearch(10);
  estimation.setViewPoint(viewpoint.x(), viewpoint.y(), viewpoint.z());
  estimation.compute(*normals);
  return normals;
}

FeatureCloud featuresOf(const Points::Ptr& points,
                        const pcl::PointCloud<pcl::Normal>::Ptr& normals) {
  FeatureCloud features;
  pcl::FPFHEstimation<Point, pcl::Normal, Feature> estimation;
  estimation.setInputCloud(points);
  estimation.setInputNormals(normals);
  estimation.setSearchMethod(std::make_shared<pcl::search::KdTree<Point>>());
  estimation.setRadiusSearch(2.0);
  estimation.compute(features);
  return features;
}

bool isFinite(const Feature& feature) {
  return std::all_of(std::begin(feature.histogram), std::end(feature.histogram),
                     [](float value) { return std::isfinite(value); });
}

Pose3 toPose(const Eigen::Matrix4f& matrix) {
  return normalized(Pose3(matrix.cast<double>()));
}

}  // namespace

struct PclScan::Data {
  Points::Ptr points;
  /** Those whose features are known, with them. */
  Points::Ptr keypoints = std::make_shared<Points>();
  FeatureCloud::Ptr features = std::make_shared<FeatureCloud>();
};

PclScan::PclScan(const Cloud& cloud) {
  auto data = std::make_shared<Data>();
  data->points = toPcl(cloud);
  const FeatureCloud features =
      featuresOf(data->points, normalsOf(data->points, cloud.viewpoints.front()));
  for (size_t i = 0; i < features.size(); ++i) {
    if (!isFinite(features[i])) continue;
    data->keypoints->push_back((*data->points)[i]);
    data->features->push_back(features[i]);
  }
  data_ = data;
}

PclResult pclGicp(const PclScan& source, const PclScan& target, const Pose3& start) {
  pcl::GeneralizedIterativeClosestPoint<Point, Point> gicp;
  gicp.setMaximumIterations(200);
  gicp.setMaxCorrespondenceDistance(0.5);
  gicp.setInputSource(source.data().points);
  gicp.setInputTarget(target.data().points);
  Points aligned;
  gicp.align(aligned, start.matrix().cast<float>());
  PclResult result;
  result.target_T_source = toPose(gicp.getFinalTransformation());
  result.gicp_fitness = gicp.getFitnessScore();
  result.converged = gicp.hasConverged();
  return result;
}

PclResult pclSacIaAndGicp(const PclScan& source, const PclScan& target) {
  pcl::SampleConsensusInitialAlignment<Point, Point, Feature> sac;
  sac.setMaximumIterations(500);
  sac.setCorrespondenceRandomness(5);
  sac.setInputSource(source.data().keypoints);
  sac.setSourceFeatures(source.data().features);
  sac.setInputTarget(target.data().keypoints);
  sac.setTargetFeatures(target.data().features);
  Points aligned;
  sac.align(aligned);
  const double sac_fitness = sac.getFitnessScore();
  PclResult result = pclGicp(source, target, toPose(sac.getFinalTransformation()));
  result.sac_fitness = sac_fitness;
  return result;
}

}  // namespace lamp
