// The built page in a browser, from a web server of its own on the loopback.
import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import path from "node:path";
import { library, page } from "../module/places.mjs";
import { processor_time_s } from "./processor_time.mjs";

const kinds = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
/** With these a page may share memory with its workers; hosts of static files mostly do not send them. */
const isolation = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };

/** Serves build/page; answers its address and how to end it. */
export function serve({ isolated = false } = {}) {
  const server = createServer((request, response) => {
    const wanted = path.join(page, path.normalize(new URL(request.url, "http://host").pathname));
    const file = wanted.endsWith("/") ? path.join(wanted, "index.html") : wanted;
    if (!file.startsWith(page) || !existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": kinds[path.extname(file)] ?? "application/octet-stream", ...(isolated ? isolation : {}) });
    createReadStream(file).pipe(response);
  });
  return new Promise((resolve) =>
    server.listen(0, "127.0.0.1", () =>
      resolve({ address: `http://127.0.0.1:${server.address().port}/`, end: () => server.close() }),
    ),
  );
}

const engines = {
  chromium: () =>
    library("playwright-core").chromium.launch({
      executablePath: process.env.ASTROLABE_CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", "--disable-dev-shm-usage"],
    }),
  // Debian's Firefox speaks WebDriver BiDi, and not the protocol of the one that Playwright builds.
  firefox: () =>
    library("playwright-core").firefox.launch({ channel: "moz-firefox", executablePath: process.env.ASTROLABE_FIREFOX ?? "/usr/bin/firefox-esr" }),
};

/** `use` on `wanted` of this page's own server, in a new window. */
export async function in_browser(wanted, options, use) {
  const server = await serve(options);
  try {
    await in_window(server.address + wanted, options, use);
  } finally {
    server.end();
  }
}

/**
 * `use` on a new window, with the times at which it was opened. What the page complains of, and each request beyond its own server,
 * is an error.
 *   engine        "chromium" unless it is "firefox"
 *   init          runs in the page before anything of its own
 *   without       addresses that are not found
 *   may_complain  whether a complaint is none
 */
export async function in_window(address, options, use) {
  const browser = await engines[options.engine ?? "chromium"]();
  try {
    const window = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
    const complaints = [];
    const complain = (text) => options.may_complain?.(text) || complaints.push(text);
    if (options.init) await window.addInitScript(options.init);
    if (options.without) await window.route(options.without, (route) => route.abort());
    window.on("pageerror", (error) => complain(error.message));
    window.on("console", (message) => message.type() === "error" && complain(message.text()));
    window.on("request", (request) => {
      if (/^https?:/.test(request.url()) && new URL(request.url()).origin !== new URL(address).origin)
        complain(`${request.url()} was asked for`);
    });
    const begun = { at_ms: performance.now(), processor_s: processor_time_s() };
    await window.goto(address);
    await use(window, begun);
    if (complaints.length > 0) throw new Error(complaints.join("\n"));
  } finally {
    await browser.close();
  }
}
