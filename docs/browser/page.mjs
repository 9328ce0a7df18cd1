// The two forms of the page: what they ask of Python (worker.mjs), and where its answers are shown.
const [rolling, judging] = document.querySelectorAll("form.browser");
const iframe = document.querySelector("iframe.rolling"), formulas = document.querySelector("details.formulas");
const near = (name) => new URL(name, import.meta.url);
let worker, answered;

// The page of a motion with another one in it.
async function roll({ data, plan }) {
  const page = await (await fetch(near("rolling.html"))).text();
  iframe.srcdoc = page
    .replace(/(<p class="plan">).*?(?=<\/p>)/s, (_, begin) => begin + plan)
    .replace(/(<script type="application\/json" id="data">).*?(?=<\/script>)/s, (_, begin) => begin + JSON.stringify(data));
  iframe.hidden = false;
}

const say = (form, lines) => { form.nextElementSibling.textContent = lines.join("\n"); };

async function submitted(event) {
  event.preventDefault();
  const form = event.target, given = Object.fromEntries(new FormData(form));
  const buttons = document.querySelectorAll("form.browser button");
  say(form, ["…"]);
  for (const button of buttons) button.disabled = true;
  const found = await new Promise((resolve) => {
    answered = resolve;
    worker.postMessage({ call: form.dataset.call, given });
  });
  for (const button of buttons) button.disabled = false;
  say(form, found.error ? [found.error] : found.said);
  if (found.data) roll(found);
  if (form === judging) {
    formulas.hidden = !found.formulas;
    formulas.lastElementChild.textContent = (found.formulas ?? []).join("\n");
  }
}

try {
  worker = new Worker(near("worker.mjs"), { type: "module" });
  worker.onmessage = ({ data }) => answered(data);
  const claims = await (await fetch(near("claims.json"))).json();
  for (const [id, title] of Object.entries(claims)) judging.elements.claim.add(new Option(`${id}: ${title}`, id));
  for (const form of [rolling, judging]) form.addEventListener("submit", submitted);
  for (const button of document.querySelectorAll("form.browser button")) button.disabled = false;
  say(rolling, []);
} catch (error) {
  say(rolling, [`The files of this page cannot be read: ${error.message}`]);
}
