#!/bin/sh
# What each part of the back end is worth on a simulated world: no loop closures, all loop closures, ICM, GNC, ICM and GNC,
# and the default stages (odometry gate, chance agreement, frames of robots, GNC).
#
#   bench/ablation.sh WORLD OUT [--set section.key=value]...
#
# Runs go to OUT/<variant>, table and box plots to OUT/comparison. With `--set pipeline.verifiers=` the back end has to do
# without the verification of registrations. LAMP_APPS is the folder of the programs.
set -eu
if [ $# -lt 2 ]; then
  sed -n '2,8s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
world=$1 out=$2
shift 2
apps=${LAMP_APPS:-$(dirname "$0")/../build/release/apps}

variant() {
  name=$1
  shift
  "$apps/lamp-slam" "$world/lamp.ini" --out "$out/$name" --set pipeline.exporters= "$@"
}
rejection() { echo "--set pipeline.outlier_rejection=$1 --set pipeline.optimizer=$2"; }

mkdir -p "$out"
variant no_loops $(rejection '' Lm) "$@" --set pipeline.candidates=
variant all_loops $(rejection '' Lm) "$@"
variant icm $(rejection Icm Lm) "$@"
variant gnc $(rejection '' Gnc) "$@"
variant icm_gnc $(rejection Icm Gnc) "$@"
variant default "$@"
set --
for name in no_loops all_loops icm gnc icm_gnc default; do set -- "$@" "$out/$name"; done
"$apps/lamp-eval" "$@" --truth "$world" --out "$out/comparison"
