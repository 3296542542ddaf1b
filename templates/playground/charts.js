// Two charts: error over time, and largest error against cost.
const SMALL = 1e-14;
const POWERS = ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"];
const power = (n) => `10${n < 0 ? "⁻" : ""}${[...String(Math.abs(n))].map((digit) => POWERS[digit]).join("")}`;

function scaleOf(low, high, from, to) {
  return (value) => from + ((value - low) / (high - low || 1)) * (to - from);
}

function decades(values) {
  // whole powers of ten around values, as exponents
  const logs = values.filter((value) => value > SMALL && value < 1e30).map(Math.log10);
  if (!logs.length) return [-6, 0];
  const [least, most] = [Math.min, Math.max].map((choose) => logs.reduce((found, value) => choose(found, value)));
  const [low, high] = [Math.floor(least), Math.ceil(most)];
  return [low, Math.max(high, low + 1)];
}

function pleasant(size) {
  // 1, 2 or 5 times a power of ten
  const ten = 10 ** Math.floor(Math.log10(size));
  return ten * [1, 2, 5, 10].find((step) => step * ten >= size * (1 - 1e-9));
}

function upright(pen, low, high, top, bottom, wide, left) {
  // lines and labels of powers of ten, not more than fit
  const y = scaleOf(low, high, bottom, top);
  const every = Math.ceil((high - low) / Math.max(1, Math.floor((bottom - top) / 22)));
  pen.fillStyle = colours.faint;
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (let n = low; n <= high; n += every) {
    line(pen, [[left, y(n)], [wide - 4, y(n)]], colours.grid, 1);
    pen.fillText(power(n), left - 6, y(n));
  }
  return (value) => y(Math.log10(Math.max(value, 10 ** low)));
}

const ERROR_TOP = 4; // no arm is farther off than some reaches: beyond, all are equally wrong

function drawErrors(found, floor, run, time) {
  const { pen, wide, high } = sized(document.getElementById("errors"));
  const [left, top, bottom] = [48, 26, high - 30];
  pen.fillStyle = colours.faint;
  pen.textAlign = "left";
  pen.textBaseline = "top";
  pen.fillText(`error of the tip (${figure.unit})`, 4, 0);
  if (!found) return;
  const most = ERROR_TOP * figure.reach;
  const shown = found.map((value) => Math.min(value, most));
  const [low, high10] = decades([...shown.filter((value) => value > 0.1 * floor), floor]);
  const y = upright(pen, low, high10, top, bottom, wide, left);
  const x = scaleOf(0, data.until, left, wide - 8);
  pen.textAlign = "center";
  pen.textBaseline = "top";
  const tick = pleasant(data.until / 5);
  for (let k = 0; k * tick <= 1.001 * data.until; k++) {
    const at = Math.min(x(k * tick), wide - 16);
    pen.fillText(`${Number((k * tick).toPrecision(6))}${k === 1 ? " s" : ""}`, at, bottom + 8);
  }
  pen.setLineDash([5, 4]);
  line(pen, [[left, y(floor)], [wide - 8, y(floor)]], colours["fine-ink"], 1.2);
  pen.setLineDash([]);
  const every = Math.max(1, Math.floor(shown.length / (2 * wide)));
  const points = [];
  for (let k = 0; k < shown.length; k += every) {
    points.push([x(k * run.step), y(Math.max(...shown.slice(k, k + every)))]);
  }
  line(pen, points, colours.arm, 1.8);
  line(pen, [[x(time), top], [x(time), bottom]], colours.faint, 1);
}

const tried = new Map(); // "number of the method/number of the step" to error and place on the chart

const costOf = (method, step) => data.methods[method].operations / step;

function drawCosts(current, floor) {
  const { pen, wide, high } = sized(document.getElementById("costs"));
  const [left, top, bottom] = [48, 28, high - 34];
  pen.fillStyle = colours.faint;
  pen.textAlign = "left";
  pen.textBaseline = "top";
  pen.fillText(`largest error of the tip (${figure.unit})`, 4, 0);
  const entries = [...tried.values()].filter((each) => Number.isFinite(each.error));
  const most = ERROR_TOP * figure.reach;
  const [low, high10] = decades(entries.map((each) => Math.min(Math.max(each.error, floor), most)));
  const y = upright(pen, low, high10, top, bottom, wide, left);
  const costs = data.methods.flatMap((_, n) => steps.map((step) => costOf(n, step)));
  const [cheap, dear] = [Math.log10(Math.min(...costs)) - 0.1, Math.log10(Math.max(...costs)) + 0.1];
  const x = scaleOf(cheap, dear, left, wide - 8);
  pen.textAlign = "center";
  pen.textBaseline = "top";
  for (let n = Math.ceil(cheap); n <= dear; n++) {
    line(pen, [[x(n), top], [x(n), bottom]], colours.grid, 1);
    pen.fillText(power(n), x(n), bottom + 4);
  }
  pen.textAlign = "right";
  pen.fillText("operations per simulated second", wide - 8, bottom + 19);
  data.methods.forEach((_, method) => {
    const points = [];
    const colour = colours.lines[method];
    steps.forEach((step, number) => {
      const each = tried.get(`${method}/${number}`);
      if (!each) return;
      each.x = x(Math.log10(costOf(method, step)));
      each.y = Number.isFinite(each.error) ? y(Math.min(Math.max(each.error, floor), most)) : top - 3;
      if (Number.isFinite(each.error)) points.push([each.x, each.y]);
      else for (const side of [3, -3]) line(pen, [[each.x - 3, each.y - side], [each.x + 3, each.y + side]], colour, 1.5);
    });
    line(pen, points, colour, 1.5);
    for (const point of points) dot(pen, point, 3.5, colour);
  });
  const own = tried.get(current);
  if (own?.x) {
    pen.strokeStyle = colours.ink;
    pen.lineWidth = 2;
    pen.beginPath();
    pen.arc(own.x, own.y, 8, 0, 2 * Math.PI);
    pen.stroke();
  }
}
