const kTried = "astrolabe-isolation";

// A page that is isolated may try it again when it is not any more.
if (crossOriginIsolated) sessionStorage.removeItem(kTried);

/** Has this page come from now on as one that may share memory with its workers, and loads it anew. Throws if the browser cannot. */
export async function load_isolated() {
  if (!("serviceWorker" in navigator) || sessionStorage.getItem(kTried) !== null)
    throw new Error("This page may share no memory here, which a port needs: open it in a window of its own, in another browser.");
  await navigator.serviceWorker.register("isolation.js");
  await navigator.serviceWorker.ready;
  sessionStorage.setItem(kTried, "1");
  location.reload();
}
