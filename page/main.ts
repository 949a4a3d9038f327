import { WheatstonePicture } from "./element";

if (!customElements.get("wheatstone-picture")) customElements.define("wheatstone-picture", WheatstonePicture);
