// Python in the page, away from its window: what in_browser.py answers to a call, or why there is no answer.
const python = (async () => {
  let loadPyodide;
  try {
    ({ loadPyodide } = await import("../pyodide/pyodide.mjs"));
  } catch {
    throw new Error("Pyodide's files are not next to this page: see below how to put them there");
  }
  const loaded = await loadPyodide({ indexURL: new URL("../pyodide/", import.meta.url).href });
  loaded.unpackArchive(await (await fetch(new URL("chapsym.zip", import.meta.url))).arrayBuffer(), "zip");
  return loaded.pyimport("in_browser");
})();
python.catch(() => {}); // said at the first call

self.onmessage = async ({ data: { call, given } }) => {
  try {
    self.postMessage(JSON.parse((await python).called(call, JSON.stringify(given))));
  } catch (error) {
    self.postMessage({ error: error.message });
  }
};
