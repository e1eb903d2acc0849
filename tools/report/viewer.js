// Two maps side by side under one camera. The page holds them as JSON in #maps: cells as differences from one to the
// next, split into planes of bytes, deflated, in base64 (tools/report_cells.cpp).
(function () {
  'use strict';
  const kCubePixels = 3.5;  // smaller cells are drawn as dots, which is many times less work
  const start = performance.now();
  const page = JSON.parse(document.getElementById('maps').textContent);
  const element = id => document.getElementById(id);

  async function inflate(base64) {
    const bytes = Uint8Array.from(atob(base64), c => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /// Keys of the cells, three a cell, and a byte of bits a cell: 1 for what moved, 2 for what is right below another.
  async function decode(map) {
    const bytes = await inflate(map.cells);
    const n = map.count, cells = new Uint16Array(3 * n);
    for (let axis = 0; axis < 3; ++axis) {
      const low = 2 * axis * n, high = low + n;
      for (let i = 0, key = 0; i < n; ++i) {
        const zigzag = bytes[low + i] | bytes[high + i] << 8;
        key = (key + ((zigzag >> 1) ^ -(zigzag & 1))) & 0xffff;
        cells[3 * i + axis] = key;
      }
    }
    return {cells, bits: bytes.slice(6 * n, 7 * n)};
  }

  // Of a cube at most three sides face the eye: a corner of three squares is turned towards it, cube by cube.
  function halfCube() {
    const corners = [], sides = [], index = [];
    for (let axis = 0; axis < 3; ++axis) {
      for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
        const corner = [0, 0, 0];
        corner[axis] = 0.5;
        corner[(axis + 1) % 3] = u / 2;
        corner[(axis + 2) % 3] = v / 2;
        corners.push(...corner);
        sides.push(axis);
      }
      index.push(...[0, 1, 2, 0, 2, 3].map(i => 4 * axis + i));
    }
    return {corners, sides, index};
  }

  const colouring = `
    attribute float bits;
    uniform vec2 heights;
    uniform float byHeight;
    varying vec3 colour;
    vec3 ramp(float t) {
      vec3 low = mix(vec3(.33, .36, .66), vec3(.20, .64, .64), clamp(3. * t, 0., 1.));
      vec3 middle = mix(low, vec3(.70, .83, .31), clamp(3. * t - 1., 0., 1.));
      return mix(middle, vec3(.96, .62, .24), clamp(3. * t - 2., 0., 1.));
    }
    vec3 colourAt(float z) {
      vec3 plain = mix(vec3(.67, .71, .75), ramp(clamp((z - heights.x) / (heights.y - heights.x), 0., 1.)), byHeight);
      return mix(plain, vec3(.87, .15, .15), mod(bits, 2.));
    }`;
  const cubeShader = colouring + `
    attribute float side;
    attribute vec3 cell;
    uniform vec3 eye;
    void main() {
      vec3 centre = cell + .5;
      vec3 towards = sign(eye - centre) + vec3(equal(eye, centre));
      gl_Position = projectionMatrix * modelViewMatrix * vec4(centre + position * towards, 1.);
      float light = side > 1.5 ? (towards.z > 0. ? 1. : .5) : side > .5 ? .7 : .82;
      colour = light * colourAt(cell.z);
    }`;
  // From afar a cell is a dot: bright where its top can be seen, as of cubes.
  const dotShader = colouring + `
    uniform float pixels;
    void main() {
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position + .5, 1.);
      gl_PointSize = max(1.5, 1.3 * pixels / gl_Position.w);
      colour = (bits > 1.5 ? .76 : 1.) * colourAt(position.z);
    }`;
  const fragmentShader = `
    varying vec3 colour;
    void main() { gl_FragColor = vec4(colour, 1.); }`;

  // As three.js calls it, by its age.
  const setAttribute = (geometry, name, value) =>
      (geometry.setAttribute || geometry.addAttribute).call(geometry, name, value);

  function cubesOf(decoded, material) {
    const {corners, sides, index} = halfCube();
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setIndex(index);
    setAttribute(geometry, 'position', new THREE.BufferAttribute(new Float32Array(corners), 3));
    setAttribute(geometry, 'side', new THREE.BufferAttribute(new Float32Array(sides), 1));
    setAttribute(geometry, 'cell', new THREE.InstancedBufferAttribute(decoded.cells, 3));
    setAttribute(geometry, 'bits', new THREE.InstancedBufferAttribute(decoded.bits, 1));
    geometry.instanceCount = geometry.maxInstancedCount = decoded.bits.length;
    return new THREE.Mesh(geometry, material);
  }

  function dotsOf(decoded, material) {
    const geometry = new THREE.BufferGeometry();
    setAttribute(geometry, 'position', new THREE.BufferAttribute(decoded.cells, 3));
    setAttribute(geometry, 'bits', new THREE.BufferAttribute(decoded.bits, 1));
    return new THREE.Points(geometry, material);
  }

  async function run() {
    const holder = element('viewer');
    const renderer = new THREE.WebGLRenderer({antialias: true});
    renderer.setClearColor(0xfafafc);
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setScissorTest(true);
    holder.appendChild(renderer.domElement);

    const size = page.size, middle = new THREE.Vector3(...page.centre);
    const camera = new THREE.PerspectiveCamera(45, 1, 1, 20 * Math.max(...size));
    camera.up.set(0, 0, 1);
    const uniforms = {eye: {value: camera.position}, heights: {value: new THREE.Vector2(...page.heights)},
                      byHeight: {value: 1}, pixels: {value: 1}};
    const cubes = new THREE.ShaderMaterial({vertexShader: cubeShader, fragmentShader, side: THREE.DoubleSide, uniforms});
    const dots = new THREE.ShaderMaterial({vertexShader: dotShader, fragmentShader, uniforms});

    const scenes = {};
    for (const map of page.maps) {
      scenes[map.name] = new THREE.Scene();
      const decoded = await decode(map);
      for (const object of [cubesOf(decoded, cubes), dotsOf(decoded, dots)]) {
        object.frustumCulled = false;
        scenes[map.name].add(object);
      }
      for (const side of ['left-map', 'right-map']) element(side).add(new Option(map.name));
    }
    element('left-map').value = page.maps[0].name;
    element('right-map').value = page.maps[page.maps.length - 1].name;

    const controls = new THREE.OrbitControls(camera, renderer.domElement);
    controls.screenSpacePanning = true;
    let waiting = false;
    const draw = () => {
      waiting = false;
      const width = holder.clientWidth, height = holder.clientHeight, half = Math.floor(width / 2);
      camera.aspect = half / height;
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
      // Of a cell at distance 1, and of one where the camera looks.
      const pixels = height * renderer.getPixelRatio() / (2 * Math.tan(camera.fov * Math.PI / 360));
      uniforms.pixels.value = pixels;
      dots.visible = pixels / camera.position.distanceTo(controls.target) < kCubePixels;
      cubes.visible = !dots.visible;
      ['left', 'right'].forEach((side, i) => {
        const name = element(side + '-map').value;
        element(side + '-name').textContent = name;
        renderer.setViewport(i * half, 0, half, height);
        renderer.setScissor(i * half, 0, half - (i === 0 ? 1 : 0), height);
        renderer.render(scenes[name], camera);
      });
    };
    const later = () => { if (!waiting) { waiting = true; requestAnimationFrame(draw); } };
    const resize = () => { renderer.setSize(holder.clientWidth, holder.clientHeight); later(); };
    const look = (x, y, z) => {
      const reach = 0.75 * Math.max(size[0], size[1]);
      camera.position.set(middle.x + reach * x, middle.y + reach * y, middle.z + reach * z);
      controls.target.copy(middle);
      controls.update();
      later();
    };
    controls.addEventListener('change', later);
    addEventListener('resize', resize);
    for (const side of ['left-map', 'right-map']) element(side).addEventListener('change', later);
    element('colouring').addEventListener('change', event => {
      uniforms.byHeight.value = event.target.value === 'height' ? 1 : 0;
      later();
    });
    element('view-top').addEventListener('click', () => look(0, -0.001, 1.2));
    element('view-slant').addEventListener('click', () => look(-0.45, -0.55, 0.5));
    resize();
    look(-0.45, -0.55, 0.5);
    draw();
    const total = page.maps.reduce((sum, map) => sum + map.count, 0);
    element('viewer-state').textContent = total.toLocaleString('en') + ' cells';
    document.body.dataset.viewer = 'drawn';
    document.body.dataset.viewerMs = Math.round(performance.now() - start);
    document.body.dataset.openedMs = Math.round(performance.now());
  }

  run().catch(error => {
    element('viewer-state').textContent = 'no 3D view here: ' + error.message;
    document.body.dataset.viewer = 'failed';
  });
})();
