import { readdirSync, readFileSync } from "node:fs";

const kTicksPerSecond = 100; // of Linux, as seen from programs

const text_of = (file) => {
  try {
    return readFileSync(file, "utf8");
  } catch {
    return ""; // it has ended in the meantime
  }
};
const numbers_in = (folder) => {
  try {
    return readdirSync(folder).filter((name) => /^\d+$/.test(name)).map(Number);
  } catch {
    return [];
  }
};
/** What the kernel says behind the name: state, parent, ... */
const stat = (file) => text_of(file).replace(/^.*\) /s, "").split(" ");

/**
 * Processor time of the page's own thread and of its workers, s. They wait for each other, so on an idle machine this is how long a
 * person waits; other programs hardly change it.
 */
export function processor_time_s() {
  const parents = new Map(numbers_in("/proc").map((id) => [id, Number(stat(`/proc/${id}/stat`)[1])]));
  const is_ours = (id) => id === process.pid || (parents.has(id) && is_ours(parents.get(id)));
  let ticks = 0;
  for (const id of parents.keys()) {
    if (!is_ours(id) || !text_of(`/proc/${id}/cmdline`).includes("--type=renderer")) continue;
    for (const thread of numbers_in(`/proc/${id}/task`)) {
      const place = `/proc/${id}/task/${thread}`;
      if (thread !== id && !text_of(`${place}/comm`).startsWith("DedicatedWorker")) continue;
      const [user, system] = stat(`${place}/stat`).slice(11, 13);
      ticks += Number(user ?? 0) + Number(system ?? 0);
    }
  }
  return ticks / kTicksPerSecond;
}
