// Smith's Lambda of Gaussian slopes as a rational function of a = cot(theta) / (sqrt(2) sigma), sigma the standard
// deviation of slope towards the direction (Walter 2007, section 5.2; Heitz 2014).
float beckmannLambda(float a) {
  return a < 1.6 ? (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a) : 0.0;
}
