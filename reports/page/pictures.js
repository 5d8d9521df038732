// The picture viewer: any two pictures of a world and frame, with a slider, alternating, or side by side.
const pictureViewer = (() => {
    const { element: make } = pageKit;
    const { digits } = chartStyle;
    const nameOf = picture => (picture.difference ? `difference: ${words.labelText(picture.label)}` : words.labelText(picture.label));
    const secondsPerTurn = 0.7;
    const isReference = picture => picture.label.startsWith('reference');
    const isEmbedded = picture => picture.source.startsWith('data:');

    /// `PSNR 44.4 dB, SSIM 0.998, FLIP 0.00332`
    const numbersOf = ({ numbers = {} }) => [['psnr_db', 'PSNR', ' dB'], ['ssim', 'SSIM', ''], ['flip', 'FLIP', '']]
        .filter(([key]) => numbers[key] !== undefined).map(([key, name, unit]) => `${name} ${digits(numbers[key])}${unit}`).join(', ');
    /// The picture with the largest error, preferring those embedded in this file.
    const worstOf = sets => {
        const judged = sets.flatMap(set => set.pictures.filter(picture => !picture.difference && picture.numbers?.flip !== undefined).map(picture => ({ set, picture })));
        return judged.sort((a, b) => isEmbedded(b.picture) - isEmbedded(a.picture) || b.picture.numbers.flip - a.picture.numbers.flip)[0];
    };
    /// The colours of a difference map, from no error to the largest possible one.
    const colourBar = heat => make('div', { className: 'colour-bar', hidden: true }, [
        make('span', { textContent: '0' }), make('i', { style: `background: linear-gradient(to right, ${heat.join(', ')})` }), make('span', { textContent: '1' }), make('span', { textContent: 'FLIP per pixel' }),
    ]);

    /// `isMain`: whether the viewer may open on an experiment.
    const build = (report, titleOf, isMain = () => true) => {
        // Worlds with ground truth first: they are the most informative.
        const isJudged = set => set.pictures.some(picture => picture.label === 'reference');
        const sets = [...report.data.pictures].sort((a, b) => isJudged(b) - isJudged(a));
        const worlds = [...new Map(sets.map(set => [`${set.experiment}\n${set.world}`, set])).values()]
            .map(set => ({ set, text: [titleOf(set.experiment), words.readable(set.world)].filter(Boolean).join(' · ') }))
            .sort((a, b) => isJudged(b.set) - isJudged(a.set) || a.text.localeCompare(b.text, 'en', { numeric: true }));
        const worst = worstOf(sets.filter(set => isMain(set.experiment))) || worstOf(sets);
        const choice = (label, className) => {
            const select = make('select', { className });
            return [select, make('label', { className: 'control' }, [make('span', { textContent: label }), select])];
        };
        const [world, worldControl] = choice('World', 'world');
        const [left, leftControl] = choice('Left', 'left');
        const [right, rightControl] = choice('Right', 'right');
        const [mode, modeControl] = choice('View', 'mode');
        const frame = make('input', { type: 'range', min: 0, value: 0, className: 'frame' });
        const frameText = make('output', { className: 'frame-text' });
        const frameControl = make('label', { className: 'control' }, [make('span', { textContent: 'Frame' }), frame, frameText]);
        worlds.forEach(({ text }, index) => world.append(new Option(text, index)));
        for (const [value, text] of [['slider', 'slider'], ['flicker', 'alternating'], ['both', 'side by side'], ['native', 'native size']]) mode.append(new Option(text, value));

        const [leftImage, rightImage] = ['left-image', 'right-image'].map(className => make('img', { className, decoding: 'sync' }));
        const [leftName, rightName] = ['left-name', 'right-name'].map(className => make('figcaption', { className }));
        const line = make('div', { className: 'divider' });
        const slider = make('input', { type: 'range', min: 0, max: 1000, value: 500, className: 'wipe', ariaLabel: 'edge of the left picture' });
        const stage = make('div', { className: 'picture-stage' }, [leftImage, rightImage, line]);
        // Below the picture, not in it, where they would cover the dust.
        const names = make('div', { className: 'picture-names' }, [leftName, rightName]);
        // A printed page shows no controls, so the choice is written out.
        const said = make('p', { className: 'picture-world muted' });
        const bar = colourBar(report.data.heat || []);
        const missing = make('p', { className: 'note missing', hidden: true });
        const place = make('div', { className: 'picture-viewer' }, [
            make('div', { className: 'controls' }, [worldControl, frameControl, leftControl, rightControl, modeControl]), said, stage, names, slider, bar, missing,
        ]);

        let timer = null;
        const framesHere = () => sets.filter(set => set.experiment === worlds[world.value].set.experiment && set.world === worlds[world.value].set.world)
            .sort((a, b) => a.frame - b.frame);
        const setNow = () => framesHere()[frame.value];
        const showWipe = () => {
            const share = slider.value / 10;
            const sliding = mode.value === 'slider' || mode.value === 'native';
            rightImage.style.clipPath = sliding ? `inset(0 0 0 ${share}%)` : '';
            line.style.left = `${share}%`;
            line.hidden = slider.hidden = !sliding;
        };
        /// Small pictures are magnified up to twice, except at native size.
        const showSize = () => {
            const { width } = setNow();
            const widest = mode.value === 'native' && width ? width : width ? Math.min(1280, Math.max(2 * width, 480)) : 960;
            stage.style.setProperty('--widest', `${widest}px`);
            names.style.maxWidth = mode.value === 'both' ? '' : `${widest}px`;
            slider.style.maxWidth = `${widest}px`;
        };
        const showMode = () => {
            clearInterval(timer);
            rightImage.style.visibility = rightName.style.visibility = leftName.style.visibility = '';
            stage.classList.toggle('both', mode.value === 'both');
            stage.classList.toggle('native', mode.value === 'native');
            showSize();
            stage.classList.toggle('turns', mode.value === 'flicker');
            if (mode.value === 'flicker') {
                let onTop = true;
                const turn = () => {
                    onTop = !onTop;
                    rightImage.style.visibility = rightName.style.visibility = onTop ? '' : 'hidden';
                    leftName.style.visibility = onTop ? 'hidden' : '';
                };
                turn();
                timer = setInterval(turn, secondsPerTurn * 1000);
            }
            showWipe();
        };
        const showPictures = () => {
            const set = setNow();
            const [a, b] = [set.pictures[left.value], set.pictures[right.value]];
            [[leftImage, leftName, a], [rightImage, rightName, b]].forEach(([image, caption, picture]) => {
                image.src = picture.source;
                image.alt = nameOf(picture);
                const numbers = numbersOf(picture);
                caption.replaceChildren(make('b', { textContent: nameOf(picture) }), ...(numbers ? [make('span', { textContent: numbers })] : []));
                if (set.width) [image.width, image.height] = [set.width, set.height];
            });
            bar.hidden = !(a.difference || b.difference);
            missing.hidden = true;
            showSize();
            frameText.textContent = set.frame;
            said.textContent = `${worlds[world.value].text}, frame ${set.frame}`;
        };
        /// The same names stay chosen from frame to frame and from world to world.
        const showNames = () => {
            const names = setNow().pictures.map(nameOf);
            const pick = (select, otherwise) => {
                const before = select.selectedOptions[0]?.text;
                select.replaceChildren(...names.map((name, index) => new Option(name, index)));
                select.value = Math.max(names.includes(before) ? names.indexOf(before) : otherwise, 0);
            };
            // A method is compared with its own finer setting if there is one, otherwise with the ground truth.
            const { pictures } = setNow();
            const judged = pictures.findIndex(picture => worst && picture.label === worst.picture.label && !picture.difference);
            const other = judged >= 0 ? judged : Math.max(pictures.findIndex(picture => !isReference(picture)), 0);
            const finer = pictures.findIndex(picture => picture.label === `reference of ${pictures[other].label}`);
            const exact = Math.max(finer >= 0 ? finer : pictures.findIndex(isReference), 0);
            pick(left, exact);
            pick(right, other !== exact ? other : names.findIndex((name, index) => index !== exact));
            showPictures();
        };
        const showWorld = () => {
            const frames = framesHere();
            frame.max = frames.length - 1;
            frame.value = Math.min(frame.value, frames.length - 1);
            frameControl.hidden = frames.length < 2;
            showNames();
        };
        world.addEventListener('change', showWorld);
        frame.addEventListener('input', showNames);
        left.addEventListener('change', showPictures);
        right.addEventListener('change', showPictures);
        mode.addEventListener('change', showMode);
        slider.addEventListener('input', showWipe);
        // There may be no runs/ next to this file: then name the picture instead of showing a broken image.
        for (const image of [leftImage, rightImage])
            image.addEventListener('error', () => {
                missing.hidden = false;
                missing.textContent = `Not embedded in this file, and not found next to it: ${image.getAttribute('src')}`;
            });
        if (worst) {
            world.value = worlds.findIndex(({ set }) => set.experiment === worst.set.experiment && set.world === worst.set.world);
            frame.max = framesHere().length - 1;
            frame.value = framesHere().indexOf(worst.set);
        }
        showWorld();
        showMode();
        return place;
    };
    return { build };
})();
