// Every signal of a drive that a chart can show, with its unit and limits.
(function (slalom) {
  'use strict';

  const { drives, number } = slalom;
  const deg = 180 / Math.PI;

  const scaled = (values, factor) => (factor === 1 ? values : values.map((v) => (v === null ? null : v * factor)));
  /** The value at speed u of what is given at every `step`. */
  const atSpeed = (values, step, u) => {
    const at = Math.max(0, u / step);
    const k = Math.min(Math.floor(at), values.length - 2);
    return values[k] + (values[k + 1] - values[k]) * (at - k);
  };
  const limit = (value, label, hard, side) => ({ value, label, hard, side });
  const WHEELS = [['rl', '--blue', 'RL'], ['rr', '--vermilion', 'RR'], ['fl', '--green', 'FL'], ['fr', '--purple', 'FR']];
  const WHEEL_WORDS = { rl: 'rear left', rr: 'rear right', fl: 'front left', fr: 'front right' };

  const column = (name, factor = 1) => ({ data: { plant } }) => [{ times: plant.t, values: scaled(plant[name], factor) }];

  /** A state or control, which a plan has, too: its column with its factor. */
  function planned(key, factor, spec) {
    return { key, symbol: key, digits: 2, of: column(key, factor), planned: [key, factor], ...spec };
  }

  /** A value of each cycle on the clock, over the time in which the cycle was planned. */
  function ofCycles(key, spec, value) {
    const of = ({ clocked }) => [{
      times: clocked.flatMap((c) => [c.t0, slalom.plannedUntil(c)]),
      values: clocked.flatMap((c) => [value(c), value(c)]),
    }];
    return { key, group: 'Planning, each cycle', digits: 2, of, ...spec };
  }

  const loadLimits = ({ data: { vehicle: v, loop } }) => [
    limit(v.Fz_min / 1000, number(v.Fz_min, 0) + ' N, least in a plan'),
    limit(loop.Fz_failure / 1000, number(loop.Fz_failure, 0) + ' N, failure', true, 'left')];
  const bothSides = (name) => ({ data: { vehicle } }) => [limit(vehicle[name] * deg, 'bound'), limit(-vehicle[name] * deg)];
  const accelerations = ({ data: { plant, vehicle: { ax_limits: { ux_step: step, most, least } } } }) => [
    { values: plant.ux.map((u) => atSpeed(most, step, u)), label: 'limits at this speed' },
    { values: plant.ux.map((u) => atSpeed(least, step, u)) }];

  /** The least of a drive's wheel loads at each instant: one curve where drives are compared. */
  function leastLoad({ data: { plant } }) {
    const columns = WHEELS.map(([wheel]) => plant['Fz_' + wheel]);
    return [{ times: plant.t, values: scaled(plant.t.map((_, i) => Math.min(...columns.map((c) => c[i]))), 1e-3) }];
  }

  const verified = (drive) => drive.clocked.some((c) => c.rung);
  const certificate = (name) => (c) => (c.certificate ? c.certificate[name] : null);
  const MOTION = 'Motion';
  const CONTROLS = 'Steering and controls';
  const LOADS = 'Wheels and clearance';

  /**
   * One entry a chart, in the order in which they are drawn. `of` gives the curves of a drive, and
   * `compared` gives one curve instead where two drives are compared; `usual` ones are shown unless
   * the reader chooses; `has` says whether a drive has the signal at all.
   */
  const catalogue = [
    planned('ux', 1, { group: MOTION, what: 'Speed', unit: 'm/s', usual: true, limits: ({ data }) => [limit(data.vehicle.ux_max, 'bound')] }),
    planned('ax', 1, { group: MOTION, what: 'Acceleration', unit: 'm/s²', usual: true, limits: accelerations }),
    planned('x', 1, { group: MOTION, what: 'Position, east', unit: 'm' }),
    planned('y', 1, { group: MOTION, what: 'Position, north', unit: 'm' }),
    planned('psi', deg, { group: MOTION, what: 'Heading', unit: '°, from east', digits: 1 }),
    planned('v', 1, { group: MOTION, what: 'Lateral speed', unit: 'm/s', zero: true }),
    planned('r', deg, { group: MOTION, what: 'Yaw rate', unit: '°/s', zero: true }),
    planned('sa', deg, { group: CONTROLS, what: 'Steering angle', unit: '°, left positive', usual: true, zero: true, limits: bothSides('sa_max') }),
    planned('sr', deg, { group: CONTROLS, what: 'Steering rate', unit: '°/s', usual: true, zero: true, limits: bothSides('sr_max') }),
    planned('jx', 1, { group: CONTROLS, what: 'Jerk', unit: 'm/s³', zero: true }),
    { key: 'Fz', group: LOADS, what: 'Wheel loads', unit: 'kN', digits: 1, floor: 0, usual: true, limits: loadLimits,
      of: (drive) => WHEELS.map(([wheel, colour, label]) => ({ label, colour, ...column('Fz_' + wheel, 1e-3)(drive)[0] })),
      compared: leastLoad, comparedWhat: 'Least wheel load' },
    ...WHEELS.map(([wheel]) => ({ key: 'Fz_' + wheel, group: LOADS, what: `Wheel load, ${WHEEL_WORDS[wheel]}`, unit: 'kN',
      digits: 2, floor: 0, limits: loadLimits, of: column('Fz_' + wheel, 1e-3) })),
    { key: 'clearance', group: LOADS, what: 'Clearance', unit: 'm beyond the crash edge', digits: 2, top: 20, usual: true,
      limits: () => [limit(0, 'crash', true)], of: column('clearance') },
    ofCycles('wall', { what: 'Solve time', unit: 's, each cycle', digits: 5, bars: true, usual: true,
      limits: ({ data: { loop } }) => [limit(loop.tex, `execution horizon tex ${loop.tex} s`, true)] }, (c) => c.wall),
    ofCycles('cpu', { what: 'Thread time of the solve', unit: 's', digits: 5, floor: 0 }, (c) => c.cpu),
    ofCycles('iterations', { what: 'Iterations', unit: '1', digits: 0, floor: 0 }, (c) => c.iterations),
    ofCycles('tf', { what: 'Horizon', symbol: 'tf', unit: 's', floor: 0 }, (c) => (c.plan.t.length ? c.plan.tf : null)),
    ofCycles('cost', { what: 'Cost', unit: '1' }, (c) => c.cost),
    ofCycles('slack', { what: 'Start slack, place', unit: 'm', digits: 3, floor: 0 }, (c) => c.start_slack[0]),
    ofCycles('slack_psi', { what: 'Start slack, heading', unit: '°', floor: 0 }, (c) => c.start_slack[1]),
    ofCycles('verified_clearance', { what: 'Least clearance as verified', unit: 'm', has: verified }, certificate('clearance')),
    ofCycles('verified_load', { what: 'Least wheel load as verified', unit: 'N', digits: 0, has: verified }, certificate('wheel_load')),
    ofCycles('verified_until', { what: 'Verified until', unit: 's', has: verified }, certificate('until')),
  ].map((spec) => ({ limits: () => [], ...spec }));

  /** The signals that any of the drives has. */
  function offered() {
    return catalogue.filter((spec) => !spec.has || drives.some(spec.has));
  }

  /** The curves of a signal: each with its drive, times [s], values, label and colour. */
  function curves(spec) {
    const two = drives.length > 1;
    return drives.flatMap((drive) => (two && spec.compared ? spec.compared : spec.of)(drive).map((curve) => ({
      label: two ? drive.letter : '', ...curve, colour: two || !curve.colour ? `--${drive.colour}` : curve.colour, drive,
    })));
  }

  /** The limits of a signal, each with its drive and the times of its values; what both drives have is there once. */
  function limits(spec) {
    const list = [];
    for (const drive of drives) {
      for (const one of spec.limits(drive)) {
        if (one.value !== undefined && list.some((l) => l.value === one.value)) continue;
        list.push({ ...one, drive });
      }
    }
    return list;
  }

  slalom.signals = { offered, curves, limits, scaled };
})(window.slalom = window.slalom || {});
