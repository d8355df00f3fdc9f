#!/bin/bash
# Submit with: sbatch THIS_FILE. A preempted task is queued again and keeps what it had finished.
# Render some tasks again with: sbatch --array=3,7 THIS_FILE
#SBATCH --job-name=@{name}
#SBATCH --array=0-@{last_task}
#SBATCH --requeue
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --output=%x-%A_%a.log
set -euo pipefail

first=$((SLURM_ARRAY_TASK_ID * @{chunk}))
exec @{command} --start "$first" --chunk @{chunk} --threads "${SLURM_CPUS_PER_TASK:-1}"
