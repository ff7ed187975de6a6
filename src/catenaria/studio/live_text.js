// A text that changes without the page around it.
export default {
  template: `<div>{{ shown }}</div>`,
  props: { content: String },
  data() {
    return { shown: this.content };
  },
  watch: {
    content(content) {
      this.show(content);
    },
  },
  mounted() {
    this.$emit("drawn");
  },
  methods: {
    show(content) {
      this.shown = content;
    },
  },
};
