// Flamenco job type. Put this file into the Manager's `scripts` folder, choose it in Blender's
// Flamenco panel or submit it by the API. Frame k is item k of the manifest.
const JOB_TYPE = {
  label: @{name},
  settings: [
    { key: "blender", type: "string", required: true, default: @{program} },
    { key: "items", type: "int32", required: true, default: @{items} },
    { key: "chunk", type: "int32", required: true, default: @{chunk} },
  ],
};

const ARGUMENTS = @{arguments};

function compileJob(job) {
  const { blender, items, chunk } = job.settings;
  for (let start = 0; start < items; start += chunk) {
    const end = Math.min(start + chunk, items) - 1;
    const task = author.Task(`render-${start}-${end}`, "blender");
    const range = ["--start", String(start), "--end", String(end)];
    task.addCommand(author.Command("exec", { exe: blender, args: ARGUMENTS.concat(range) }));
    job.addTask(task);
  }
}
