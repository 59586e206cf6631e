#!/usr/bin/env bash
# Installs what is missing, builds in release mode, maps a real recording (the 2D one that comes with
# MRPT) and a simulated one of two robots (rawlogs/demo), and compares the latter with the truth.
# Results are in demo-out; those of an earlier run are kept as demo-out.1, demo-out.2, ...
set -euo pipefail
cd "$(dirname "$0")"

scripts/install_dependencies.sh --build-only
scripts/build.sh release -DLAMP_BUILD_TESTS=OFF

out=demo-out
if [[ -e $out ]]; then
  number=1
  while [[ -e $out.$number ]]; do ((++number)); done
  mv "$out" "$out.$number"
  echo "The earlier $out is now $out.$number"
fi
bin=build/release/apps

echo "One robot, a loop of 76 m through a building, 224 laser scans:"
$bin/lamp-slam ini/sena.ini --out "$out/sena"
echo "Two robots in a simulated mine, from the same gate:"
$bin/lamp-slam rawlogs/demo/lamp.ini --out "$out/team"
$bin/lamp-eval "$out/team" --truth rawlogs/demo/truth >"$out/evaluation.txt"
grep -E 'all robots: ATE|loops kept: (pairs|precision)|map: (accuracy mean|completeness)' "$out/evaluation.txt"

cat <<END

In $out, for both recordings (sena, team):
  $out/*/maps/map.png               the map seen from above: any picture viewer
  $out/*/maps/map.ply, map.pcd      the point cloud: CloudCompare, SceneViewer3D, pcl_viewer
  $out/*/maps/map.bt, map.ot        the OctoMap: octovis
  $out/*/maps/map.yaml, map.pgm     the grid for planners: map_server of ROS; any picture viewer
  $out/*/trajectories/*.tum         the trajectories: evo_traj tum
  $out/*/graph.g2o, graph.graph     the pose graph: g2o_viewer; graph-slam (MRPT)
  $out/*/keyframes/*.rawlog         the keyed scans: RawLogViewer
  $out/*/loops.csv, summary.json    every loop closure with its reasons; counts: any text editor
  $out/evaluation.txt               the team against the truth (odometry in brackets)
  $out/team/evaluation/plots/*.png  the same as pictures; map_error.ply: coloured by error
docs/run-folder.md and docs/evaluation.md describe each file.
END
