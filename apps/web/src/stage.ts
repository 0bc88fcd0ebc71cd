// What is there besides the bodies: sky, sun and its shadows, camera.
import {
  BackSide, Box3, CustomToneMapping, DirectionalLight, Mesh, PCFShadowMap, PerspectiveCamera, Scene, ShaderMaterial, SphereGeometry, Spherical, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { kLightFunctions, kSunLight, sunOver } from './light';
import { kMostShade, Shade } from './shade';

const kLowest = Math.PI * 0.495; // of a camera, from straight up: it stays above level ground
const kNearest = 0.1; // m

function makeSky(sun: Vector3): Mesh {
  const material = new ShaderMaterial({
    side: BackSide,
    depthWrite: false,
    uniforms: { sun: { value: sun } },
    vertexShader: `varying vec3 vDirection;
      void main() { vDirection = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `${kLightFunctions}
      uniform vec3 sun; varying vec3 vDirection;
      void main() {
        gl_FragColor = vec4(skyLight(normalize(vDirection), sun), 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
  });
  const sky = new Mesh(new SphereGeometry(1, 32, 20), material);
  sky.frustumCulled = false;
  sky.renderOrder = -1;
  return sky;
}

// Whether no graphics card draws: then edges are not smoothed, which doubles what a picture costs, and the finer shade is left out.
function drawsOnProcessor(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const known = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && known ? String(gl.getParameter(known.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(42, 1, 0.02, 2000);
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  readonly shade: Shade;
  readonly shadowSamples: number; // each way
  private readonly sun = new DirectionalLight(kSunLight, 1);
  readonly sunDirection = new Vector3();
  private readonly sky = makeSky(this.sunDirection);
  private mostDistance = 100; // m, of the camera from what it turns about

  // lookFrom: from what the scene's first camera looks at to the camera; isStill: a picture is wanted, whatever it costs; checksShaders: it tells of shaders
  // that the device refuses.
  constructor(canvas: HTMLCanvasElement, lookFrom: Vector3, isStill: boolean, checksShaders: boolean) {
    this.sunDirection.copy(sunOver(lookFrom));
    const isSlow = !isStill && drawsOnProcessor();
    this.renderer = new WebGLRenderer({ canvas, antialias: !isSlow, powerPreference: 'high-performance', preserveDrawingBuffer: true });
    // Asking for a shader's faults waits until all that was drawn before is done.
    this.renderer.debug.checkShaderErrors = checksShaders;
    this.renderer.toneMapping = CustomToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;

    this.sun.castShadow = true;
    const size = Math.min(this.renderer.capabilities.maxTextureSize, 2048);
    this.sun.shadow.mapSize.set(size, size);
    this.sun.shadow.bias = -0.0004;
    this.shadowSamples = isSlow ? 2 : 3;
    this.scene.add(this.sky, this.sun, this.sun.target);
    this.renderer.shadowMap.autoUpdate = false; // they change with the bodies, not with the camera
    this.shade = new Shade(this.renderer, this.scene, this.camera, isSlow ? 0 : kMostShade);
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

  // By rad aside and up, and by a factor of the distance: for keys.
  turn(aside: number, up: number, farther: number): void {
    const { controls, camera } = this;
    const way = new Spherical().setFromVector3(camera.position.clone().sub(controls.target));
    way.theta += aside;
    way.phi = Math.min(controls.maxPolarAngle, Math.max(0.01, way.phi - up));
    way.radius = Math.min(controls.maxDistance, Math.max(controls.minDistance, way.radius * farther));
    camera.position.setFromSpherical(way).add(controls.target);
    controls.update();
  }

  // haveMoved: bodies, since the picture before.
  render(haveMoved: boolean): void {
    this.renderer.shadowMap.needsUpdate ||= haveMoved;
    // Nothing is looked at from so near, and the farther the nearest, the finer the depth.
    this.camera.near = Math.min(1, Math.max(0.008, 0.03 * this.controls.getDistance()));
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.sky.position.copy(this.camera.position); // before the shade, which sees it from inside as nothing
    this.sky.scale.setScalar(this.camera.far * 0.5);
    this.shade.render();
    this.renderer.render(this.scene, this.camera);
  }
}
