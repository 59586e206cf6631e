#!/bin/sh
# What each part of the back end is worth on a simulated world: odometry alone, all loop closures, ICM, GNC, ICM and GNC,
# the odometry gate and GNC.
#
#   bench/ablation.sh WORLD OUT [--set section.key=value]...
#
# Runs go to OUT/<variant>, table and box plots to OUT. With `--set pipeline.verifiers=` the back end has to do without the
# verification of registrations. LAMP_APPS is the folder of the programs.
set -eu
if [ $# -lt 2 ]; then
  sed -n '2,9s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
world=$1 out=$2
shift 2
apps=${LAMP_APPS:-$(dirname "$0")/../build/release/apps}

variant() {
  name=$1 rejection=$2 optimizer=$3
  shift 3
  "$apps/lamp-slam" "$world/lamp.ini" --out "$out/$name" --set pipeline.exporters= \
    --set "pipeline.outlier_rejection=$rejection" --set "pipeline.optimizer=$optimizer" "$@"
}

mkdir -p "$out"
variant odometry '' Lm "$@" --set pipeline.candidates=
variant all_loops '' Lm "$@"
variant icm Icm Lm "$@"
variant gnc '' Gnc "$@"
variant icm_gnc Icm Gnc "$@"
variant gate_gnc OdometryGate Gnc "$@"
set --
for name in odometry all_loops icm gnc icm_gnc gate_gnc; do set -- "$@" "$out/$name"; done
"$apps/lamp-eval" "$@" --truth "$world" --out "$out/comparison"
