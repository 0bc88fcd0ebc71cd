// Files that the bundle has as texts.
declare module '*.glsl' {
  const text: string;
  export default text;
}
declare module '*.inc' {
  const text: string;
  export default text;
}
