/** Has this page come from now on as one that may share memory with its workers, and loads it anew. Throws if the browser cannot. */
export async function load_isolated() {
  if (!("serviceWorker" in navigator)) throw new Error("This browser lets this page share no memory, which a port needs.");
  await navigator.serviceWorker.register("isolation.js");
  await navigator.serviceWorker.ready;
  location.reload();
}
