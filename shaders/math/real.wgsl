// The number type of all production formulas; the tests translate them at f32 and f64.
alias real = f32;
alias real2 = vec2<f32>;
alias real3 = vec3<f32>;
alias real4 = vec4<f32>;
