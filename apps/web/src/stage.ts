// What is there besides the bodies: sky, sun and its shadows, camera.
import {
  BackSide, Box3, Color, DirectionalLight, Fog, HemisphereLight, Mesh, NeutralToneMapping, PCFShadowMap, PerspectiveCamera, PMREMGenerator, Scene, ShaderMaterial, SphereGeometry, Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Shade } from './shade';

const kHorizon = new Color('#e3e6e8');
const kZenith = new Color('#86a7c8');
const kOvercast = new Color('#a9b1b8'); // of the light that comes from the sky: what lies in the shade is grey, not blue
const kLowest = Math.PI * 0.495; // of a camera, from straight up: it stays above level ground
const kNearest = 0.1; // m
const kSunElevation = 0.72; // rad
const kSunAside = 1.05; // rad, to the left of where the overview looks from: light that grazes shows the relief

function makeSky(sun: Vector3, zenith: Color): Mesh {
  const material = new ShaderMaterial({
    side: BackSide,
    depthWrite: false,
    fog: false,
    toneMapped: false,
    uniforms: { horizon: { value: kHorizon }, zenith: { value: zenith }, sun: { value: sun } },
    vertexShader: `varying vec3 vDirection;
      void main() { vDirection = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `uniform vec3 horizon, zenith, sun; varying vec3 vDirection;
      void main() {
        vec3 d = normalize(vDirection);
        vec3 c = mix(horizon, zenith, pow(clamp(d.y, 0.0, 1.0), 0.62));
        float s = max(dot(d, sun), 0.0);
        c += vec3(1.0, 0.86, 0.66) * (0.16 * pow(s, 6.0) + 0.35 * pow(s, 90.0));
        gl_FragColor = vec4(c, 1.0);
        #include <colorspace_fragment>
      }`,
  });
  const sky = new Mesh(new SphereGeometry(1, 32, 20), material);
  sky.frustumCulled = false;
  sky.renderOrder = -1;
  return sky;
}

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(42, 1, 0.02, 2000);
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  readonly shade: Shade;
  private readonly sun = new DirectionalLight('#fff3e2', 2.7);
  private readonly sunDirection = new Vector3();
  private readonly sky = makeSky(this.sunDirection, kZenith);
  private mostDistance = 100; // m, of the camera from what it turns about

  // lookFrom: the side from which the scene is seen first, horizontal.
  constructor(canvas: HTMLCanvasElement, lookFrom: Vector3) {
    this.sunDirection.copy(lookFrom).setY(0).normalize().applyAxisAngle(new Vector3(0, 1, 0), -kSunAside)
      .multiplyScalar(Math.cos(kSunElevation)).setY(Math.sin(kSunElevation));
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance', preserveDrawingBuffer: true });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.0;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene.fog = new Fog(kHorizon, 30, 160);

    const small = new Scene();
    small.add(makeSky(this.sunDirection, kOvercast));
    const generator = new PMREMGenerator(this.renderer);
    this.scene.environment = generator.fromScene(small, 0, 0.1, 10).texture;
    this.scene.environmentIntensity = 0.55;
    generator.dispose();

    this.sun.castShadow = true;
    const size = Math.min(this.renderer.capabilities.maxTextureSize, 2048);
    this.sun.shadow.mapSize.set(size, size);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.radius = 4;
    this.scene.add(this.sky, this.sun, this.sun.target, new HemisphereLight('#e6e6e2', '#a89a8a', 0.75));
    this.renderer.shadowMap.autoUpdate = false; // they change with the bodies, not with the camera
    this.shade = new Shade(this.renderer, this.scene, this.camera);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
  }

  // Shadows are drawn for this box and what surrounds it.
  fitShadows(bounds: Box3): void {
    const centre = bounds.getCenter(new Vector3());
    const radius = Math.max(0.5, bounds.getSize(new Vector3()).length() / 2);
    this.sun.position.copy(centre).addScaledVector(this.sunDirection, radius * 3);
    this.sun.target.position.copy(centre);
    const eye = this.sun.shadow.camera;
    eye.left = eye.bottom = -radius;
    eye.right = eye.top = radius;
    eye.near = radius * 0.5;
    eye.far = radius * 6;
    eye.updateProjectionMatrix();
    // Against shadow acne: about one texel of the map.
    this.sun.shadow.normalBias = Math.max(0.001, (2 * radius / this.sun.shadow.mapSize.x) * 0.9);
    this.scene.fog = new Fog(kHorizon, radius * 4 + 6, radius * 18 + 50);
    this.mostDistance = radius * 14 + 10;
  }

  // True if the size changed.
  resize(): boolean {
    const canvas = this.renderer.domElement;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (canvas.width === Math.floor(width * ratio) && canvas.height === Math.floor(height * ratio)) return false;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    return true;
  }

  // A scene's camera may be lower, nearer or farther than a visitor can go: it is taken as it is, and is the limit from there on.
  look(position: Vector3, target: Vector3, fieldOfView: number): void {
    const away = position.clone().sub(target);
    const { controls, camera } = this;
    controls.enableDamping = false; // what the mouse set swinging ends here
    controls.update();
    controls.enableDamping = true;
    controls.maxPolarAngle = Math.max(kLowest, Math.acos(away.y / Math.max(1e-9, away.length())));
    controls.minDistance = Math.min(kNearest, away.length());
    controls.maxDistance = Math.max(this.mostDistance, away.length());
    controls.target.copy(target);
    camera.position.copy(position);
    camera.fov = fieldOfView;
    camera.updateProjectionMatrix();
    controls.update();
  }

  // haveMoved: bodies, since the picture before.
  render(haveMoved: boolean): void {
    this.renderer.shadowMap.needsUpdate ||= haveMoved;
    // Nothing is looked at from so near, and the farther the nearest, the finer the depth.
    this.camera.near = Math.min(1, Math.max(0.008, 0.03 * this.controls.getDistance()));
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.shade.render();
    this.sky.position.copy(this.camera.position);
    this.sky.scale.setScalar(this.camera.far * 0.5);
    this.renderer.render(this.scene, this.camera);
  }
}
