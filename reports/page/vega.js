// Joins Debian's Vega modules, which require each other by name, into one object.
const vega = (() => {
    const loaded = {};
    const load = name => {
        if (!loaded[name]) {
            const module = { exports: {} };
            loaded[name] = module.exports;
            vegaParts[name](module.exports, load, module);
        }
        return loaded[name];
    };
    const whole = Object.assign({}, ...Object.keys(vegaParts).map(load));
    Object.assign(whole.transforms, load('vega-transforms'), load('vega-view-transforms'), load('vega-encode'));
    return whole;
})();
