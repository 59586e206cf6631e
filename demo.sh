#!/usr/bin/env bash
# Installs what is missing, builds in release mode, and maps the 2D recording that comes with MRPT.
# The run folder is demo-out; that of an earlier run is kept as demo-out.1, demo-out.2, ...
set -euo pipefail
cd "$(dirname "$0")"

scripts/install_dependencies.sh --build-only
scripts/build.sh -DLAMP_BUILD_TESTS=OFF

out=demo-out
if [[ -e $out ]]; then
  number=1
  while [[ -e $out.$number ]]; do ((++number)); done
  mv "$out" "$out.$number"
  echo "The earlier $out is now $out.$number"
fi

build/release/apps/lamp-slam ini/sena.ini --out "$out"

cat <<END

The map of one loop through a building, 224 laser scans, is in $out:
  $out/maps/map.png                 the map seen from above: any picture viewer
  $out/maps/map.ply, map.pcd        the point cloud: CloudCompare, SceneViewer3D, pcl_viewer
  $out/maps/map.bt, map.ot          the OctoMap: octovis
  $out/trajectories/*.tum           the trajectory: evo_traj tum
  $out/graph.g2o, graph.graph       the pose graph: g2o_viewer; graph-slam (MRPT)
  $out/keyframes/*.rawlog           the keyed scans: RawLogViewer
  $out/loops.csv, summary.json      every loop closure with its reasons; counts: any text editor
docs/run-folder.md describes each file.
END
