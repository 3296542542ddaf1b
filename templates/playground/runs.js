// Kernels in their modules, and runs of them.
const data = JSON.parse(document.getElementById("data").textContent);
const figure = data.figure;
const SLICE = 12; // ms of work before the page gets its turn
const shortest = data.step / 2 ** data.halvings;
const ENDS = {
  2: "the step is none", 3: "a pivot vanished", 4: "the motion outgrew all numbers", 5: "an angle left its range",
  7: "the model outgrew all numbers",
};

const pause = () => new Promise((done) => setTimeout(done, 0));

async function engine(method) {
  const code = Uint8Array.from(atob(method.wasm), (letter) => letter.charCodeAt(0));
  const { instance } = await WebAssembly.instantiate(code, {});
  const { memory, playground_address: address, playground_begin, playground_advance } = instance.exports;
  const view = (which, length) => new Float64Array(memory.buffer, address(which), length);
  const params = view(0, method.parameters.length);
  const inputs = view(1, method.inputs.length * method.slots);
  const state = view(2, Math.max(method.angles + method.count, ...method.base.map((place) => place + 1)));
  const signals = method.inputs.map((name) => data.signals.find((signal) => signal.name === name));
  return { method, params, inputs, state, signals, begin: playground_begin, advance: playground_advance };
}

function value(signal, time) {
  if (!signal.way) return signal.amplitude * Math.sin(signal.frequency * time);
  const share = Math.min(Math.max(time / signal.duration, 0), 1) - 0.5;
  return signal.way.reduceRight((sum, coefficient) => sum * share + coefficient, 0);
}

function setInputs({ method, inputs, signals }, time, step, instants, load) {
  // what acts at each stage of the step that begins at a time
  signals.forEach((signal, k) => {
    for (let slot = 0; slot < method.slots; slot++) {
      const at = time + step * instants[Math.min(slot, instants.length - 1)];
      inputs[k * method.slots + slot] = signal ? load * value(signal, at) : 0;
    }
  });
}

function setParameters({ method, params }, settings) {
  params.set(method.parameters);
  for (const [index, value] of method.payloads[settings.payload] ?? []) params[index] = value;
  const own = params.slice();
  for (const [stiffness, damping] of method.stiff) {
    if (own[stiffness] > 0) {
      params[stiffness] = settings.stiffness * own[stiffness];
      if (damping >= 0) params[damping] = settings.stiffness * own[damping];
    }
  }
}

const width = data.methods[0].count + data.methods[0].base.length;

function keep(run, { method, state }) {
  const row = run.done * width;
  for (let k = 0; k < method.count; k++) run.states[row + k] = state[method.angles + k];
  method.base.forEach((place, k) => { run.states[row + method.count + k] = state[place]; });
}

async function taken(engine, step, settings, alive) {
  // The whole run; null if something else is wanted meanwhile.
  const total = Math.round(data.until / step);
  const run = { engine, step, total, done: 0, states: new Float64Array((total + 1) * width), ended: "", milliseconds: 0 };
  const { stages } = engine.method;
  setParameters(engine, settings);
  setInputs(engine, 0, 0, [0], settings.load);
  let status = engine.begin(step);
  keep(run, engine);
  let since = performance.now();
  while (!status && run.done < total) {
    setInputs(engine, run.done * step, step, stages[Math.min(run.done, stages.length - 1)], settings.load);
    status = engine.advance();
    if (status) break;
    run.done += 1;
    keep(run, engine);
    if (run.done % 16 === 0 && performance.now() - since > SLICE) {
      run.milliseconds += performance.now() - since;
      await pause();
      if (!alive()) return null;
      since = performance.now();
    }
  }
  run.milliseconds += performance.now() - since;
  if (status) run.ended = ENDS[status] ?? `the kernel returned ${status}`;
  return alive() ? run : null;
}
