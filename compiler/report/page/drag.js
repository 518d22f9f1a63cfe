// The tool of two axes, led through its workspace by the pointer; what it feels comes from the emitted code.
const follow_time = 0.03;  // in which the tip's way to the pointer shrinks to 1/e [s]
const longest_frame = 0.05;  // what a page that was hidden catches up with [s]
const longest_arrow = 70;  // of the map
const nearest = 1e-9;  // from where on the tip is where the pointer is [m]

// The inner angle at the motor axis of a triangle of two links and the way from there to the tip.
const corner = (way, near, far) => Math.acos((way * way + near * near - far * far) / (2 * near * way));

// The joints that put the tip there: elbows outward, as in the compiler's kinematics.
function joints_at(arm, [x, y]) {
  if (arm.kind === 'cartesian') return [x, y];
  const a = arm.proximal, b = arm.distal;
  if (arm.kind === 'five_bar') {
    const left = x + arm.base / 2, right = x - arm.base / 2;
    return [Math.atan2(y, left) + corner(Math.hypot(left, y), a, b), Math.atan2(y, right) - corner(Math.hypot(right, y), a, b)];
  }
  const way = Math.hypot(x, y), bearing = Math.atan2(y, x), first = bearing - corner(way, a, b);
  return [first, arm.kind === 'serial' ? Math.PI - corner(a, b, way) : bearing + corner(way, b, a)];
}

// How the joints turn as the tip moves, ∂q_j/∂x_i at [i][j], from two places a micrometre or so apart.
function joints_by_tip(arm, tip) {
  const step = 1e-5 * (arm.proximal + arm.distal);
  const turned = arm.kind === 'cartesian' ? (way) => way : (way) => way - 2 * Math.PI * Math.round(way / (2 * Math.PI));
  return [0, 1].map((i) => {
    const [ahead, behind] = [step, -step].map((by) => joints_at(arm, tip.map((u, k) => (k === i ? u + by : u))));
    return ahead.map((q, j) => turned(q - behind[j]) / (2 * step));
  });
}

// Lines from the motor axes over the elbows to the tip [m].
function chains_of(arm, joints, tip) {
  const elbow = (base, angle) => [base + arm.proximal * Math.cos(angle), arm.proximal * Math.sin(angle)];
  if (arm.kind === 'cartesian') return [];
  if (arm.kind !== 'five_bar') return [[[0, 0], elbow(0, joints[0]), tip]];
  return [-arm.base / 2, arm.base / 2].map((base, side) => [[base, 0], elbow(base, joints[side]), tip]);
}

// A tip without mass that is led after `target`; `felt` is what it feels of the law, after the last sample.
function led_tip(law, drag) {
  const middle = drag.workspace.map(([low, high]) => (low + high) / 2);
  const nearer = 1 - Math.exp(-drag.period / follow_time);
  const led = { tip: middle, target: middle, felt: null, energy: null };
  led.start_over = () => {
    led.tip = [...led.target];
    law.reset(...joints_at(drag.arm, led.tip));
    led.energy = { hand: 0, brakes: 0, motors: 0 };
    led.sample();
  };
  // To `tip`, with this velocity there.
  led.sample = (tip = led.tip, speed = [0, 0]) => {
    led.tip = tip;
    const joints = joints_at(drag.arm, tip), by_tip = joints_by_tip(drag.arm, tip);
    const velocity = [0, 1].map((j) => by_tip[0][j] * speed[0] + by_tip[1][j] * speed[1]);
    law.step(...joints, ...velocity);
    const motors = [law.torque(0), law.torque(1)], all = [...motors];
    const damping = drag.brakes.map((_, k) => law.damping(k));
    let heat = 0;
    drag.brakes.forEach((along, k) => {
      const rate = along[0] * velocity[0] + along[1] * velocity[1];
      heat += damping[k] * rate * rate;
      along.forEach((share, j) => { all[j] += damping[k] * rate * share; });
    });
    const power = (torque) => torque[0] * velocity[0] + torque[1] * velocity[1];
    led.energy.brakes += drag.period * heat;
    led.energy.motors -= drag.period * power(motors);
    led.energy.hand += drag.period * power(all);
    led.felt = { joints, velocity, damping, motors, force: by_tip.map((row) => -(row[0] * all[0] + row[1] * all[1])) };
  };
  led.way = () => Math.hypot(...led.target.map((u, i) => u - led.tip[i]));
  led.lead = (samples) => {
    for (let k = 0; k < samples; ++k) {
      if (led.way() < nearest) { led.sample([...led.target]); continue; }
      const tip = led.tip.map((u, i) => u + nearer * (led.target[i] - u));
      led.sample(tip, tip.map((u, i) => (led.target[i] - u) / follow_time));
    }
  };
  led.start_over();
  return led;
}

// Numbers beside the map, by name.
function set_up_numbers(list, drag) {
  const lines = [['force', 'force on the tip', 'N', ''], ['speed', 'speed of the tip', 'mm/s', ''],
                 ...drag.brakes.map((_, k) => [`damping-${k + 1}`, `brake ${k + 1}`, drag.damping_unit, 'brake']),
                 ...[1, 2].map((j) => [`torque-${j}`, `motor ${j}`, drag.torque_unit, 'motor']),
                 ['hand', 'energy that the hand has put in', 'mJ', ''], ['heat', 'made into heat by the brakes', 'mJ', 'brake'],
                 ['given', 'given by the motors', 'mJ', 'motor'], ['stored', 'in the springs', 'mJ', '']];
  for (const [name, label, unit, channel] of lines) {
    const part = document.createElement('div'), term = document.createElement('dt'), value = document.createElement('dd');
    part.className = channel;
    term.textContent = label;
    value.append(Object.assign(document.createElement('span'), { id: `felt-${name}` }), ' ',
                 Object.assign(document.createElement('small'), { textContent: unit }));
    part.append(term, value);
    list.append(part);
  }
  return (name, value) => { element(`felt-${name}`).textContent = rounded(Number(value.toPrecision(3))); };
}

// The arm, its tool and the force on it, on top of the map.
function set_up_drawing(svg, drag) {
  const at = ([x, y]) => [drag.frame.x + drag.frame.metre * x, drag.frame.y - drag.frame.metre * y];
  const part = (name, kind) => {
    const made = document.createElementNS('http://www.w3.org/2000/svg', name);
    made.setAttribute('class', kind);
    return svg.appendChild(made);
  };
  const links = part('path', 'link'), arrow = part('path', 'arrow'), tool = part('circle', 'tool');
  tool.setAttribute('r', 9);
  let largest = 0;
  return (led) => {
    const [x, y] = at(led.tip), [fx, fy] = led.felt.force, size = Math.hypot(fx, fy);
    largest = Math.max(largest, size);
    const d = chains_of(drag.arm, led.felt.joints, led.tip).map((chain) => 'M' + chain.map((p) => at(p).join(' ')).join('L'));
    links.setAttribute('d', d.join(''));
    tool.setAttribute('cx', x);
    tool.setAttribute('cy', y);
    const long = size > 0 ? (longest_arrow * size) / largest : 0;
    if (long < 1) return arrow.setAttribute('d', '');
    const [ax, ay] = [(long * fx) / size, (-long * fy) / size], head = Math.min(8, long / 2) / long;
    const wing = (side) => `M${x + ax} ${y + ay}l${-head * (ax + side * ay)} ${-head * (ay - side * ax)}`;
    arrow.setAttribute('d', `M${x} ${y}l${ax} ${ay}${wing(0.5)}${wing(-0.5)}`);
  };
}

async function set_up_drag(drag) {
  const bytes = Uint8Array.from(atob(drag.module), (c) => c.charCodeAt(0));
  const law = (await WebAssembly.instantiate(bytes)).instance.exports;
  const svg = document.querySelector('#drag svg'), led = led_tip(law, drag);
  const say = set_up_numbers(element('felt'), drag), draw = set_up_drawing(svg, drag);

  function show() {
    const { felt, energy } = led;
    say('force', Math.hypot(...felt.force));
    say('speed', (1e3 * led.way()) / follow_time);
    felt.damping.forEach((damping, k) => say(`damping-${k + 1}`, damping));
    felt.motors.forEach((torque, j) => say(`torque-${j + 1}`, torque));
    say('hand', 1e3 * energy.hand);
    say('heat', 1e3 * energy.brakes);
    say('given', 1e3 * energy.motors);
    say('stored', 1e3 * law.stored_energy());
    draw(led);
  }

  // Frame by frame, until the tip has come to rest and the force no longer changes.
  let last = 0, quiet = 0, running = false, held = false;
  function frame(now) {
    const before = led.felt.force;
    led.lead(Math.round(Math.min(longest_frame, (now - last) / 1e3) * drag.rate));
    last = now;
    const change = Math.hypot(...led.felt.force.map((f, i) => f - before[i]));
    quiet = led.way() === 0 && change <= 1e-6 * Math.hypot(...before) ? quiet + 1 : 0;
    show();
    running = held || quiet < 10;
    if (running) requestAnimationFrame(frame);
  }
  function run() {
    quiet = 0;
    if (running) return;
    running = true;
    last = performance.now();
    requestAnimationFrame(frame);
  }
  function lead_to(place) {
    led.target = place.map((u, i) => Math.min(drag.workspace[i][1], Math.max(drag.workspace[i][0], u)));
    run();
  }
  function follow(event) {
    const on_map = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    lead_to([(on_map.x - drag.frame.x) / drag.frame.metre, (drag.frame.y - on_map.y) / drag.frame.metre]);
  }
  svg.addEventListener('pointerdown', (event) => {
    svg.setPointerCapture(event.pointerId);
    held = true;
    follow(event);
  });
  svg.addEventListener('pointermove', (event) => { if (held) follow(event); });
  for (const end of ['pointerup', 'pointercancel']) svg.addEventListener(end, () => { held = false; });
  svg.tabIndex = 0;
  const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
  svg.addEventListener('keydown', (event) => {
    const way = ways[event.key];
    if (!way) return;
    event.preventDefault();
    lead_to(led.target.map((u, i) => u + (way[i] * (drag.workspace[i][1] - drag.workspace[i][0])) / 40));
  });
  element('start-over').addEventListener('click', () => { led.start_over(); show(); });
  show();
}
