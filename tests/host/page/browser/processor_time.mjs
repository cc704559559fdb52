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

/** The processes in which pages of this test's browser run. Its own buttons are pages, too, but not what is tested. */
function renderers() {
  const parents = new Map(numbers_in("/proc").map((id) => [id, Number(stat(`/proc/${id}/stat`)[1])]));
  const is_ours = (id) => id === process.pid || (parents.has(id) && is_ours(parents.get(id)));
  const is_page = (words) => words.includes("--type=renderer") && !words.includes("--top-chrome-webui");
  return [...parents.keys()].filter((id) => is_ours(id) && is_page(text_of(`/proc/${id}/cmdline`)));
}

function seconds_in(file) {
  const [user, system] = stat(file).slice(11, 13);
  return (Number(user ?? 0) + Number(system ?? 0)) / kTicksPerSecond;
}

/**
 * Processor time of the page's own thread and of its workers, s. They wait for each other, so on an idle machine this is how long a
 * person waits; other programs hardly change it.
 */
export function processor_time_s() {
  let all_s = 0;
  for (const id of renderers())
    for (const thread of numbers_in(`/proc/${id}/task`)) {
      const place = `/proc/${id}/task/${thread}`;
      if (thread === id || text_of(`${place}/comm`).startsWith("DedicatedWorker")) all_s += seconds_in(`${place}/stat`);
    }
  return all_s;
}

/** Processor time of a program and all its threads, s. */
export const program_time_s = (id) => seconds_in(`/proc/${id}/stat`);

/** A clock of the page's own thread: how long it has computed, ms. The one that computed most so far is the page's. */
export function page_thread_clock() {
  const computed_ms = (id) => Number(text_of(`/proc/${id}/schedstat`).split(" ")[0]) / 1e6;
  const [page] = renderers().sort((a, b) => computed_ms(b) - computed_ms(a));
  return () => computed_ms(page);
}
