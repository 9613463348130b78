#!/bin/bash
#SBATCH --job-name=jred-vary
#SBATCH --array=0-7
#SBATCH --cpus-per-task=4
#SBATCH --time=01:00:00
#SBATCH --requeue
# A study of the press in eight shares:
#
#   sbatch machines/cluster/vary.slurm.sh
#   (head -n 1 press.part-0.csv; tail -q -n +2 press.part-*.csv | sort -n) > press.csv
#
# The index begins at 0. A task that was stopped or requeued goes on where it was.
set -euo pipefail

machine=${MACHINE:-machines/press.toml}
out=${OUT:-press}

export RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1}
exec jred vary "$machine" \
    --vary "${SLIDER:-slider.mass=30..60kg:40}" \
    --vary "${DURATION:-motion.segment.1.duration=0.3..0.6s:25}" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
    --out "$out.part-$SLURM_ARRAY_TASK_ID.csv" --resume
